-- text.lua - small tools for text, lists and files.

local function readFile(path)
  local file = io.open(path, 'rb')
  if not file then return nil end
  local text = file:read 'a' -- nil for a folder
  file:close()
  return text
end
local function writeFile(path, text)
  local file = assert(io.open(path, 'wb'))
  file:write(text)
  file:close()
end

local function quote(text) return "'" .. text:gsub("'", "'\\''") .. "'" end
local function escape(text)
  return (text:gsub('[&<>"]', { ['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;', ['"'] = '&quot;' }))
end
local function html(text) return pandoc.RawBlock('html', text) end
local function lines(text)
  local all = {}
  for line in (text:gsub('\r', '') .. (text:sub(-1) == '\n' and '' or '\n')):gmatch '(.-)\n' do all[#all + 1] = line end
  return all
end
local function split(text, separator)
  local all = {}
  for part in (text .. separator):gmatch('(.-)' .. separator) do all[#all + 1] = part end
  return all
end
local function contains(list, wanted)
  for _, one in ipairs(list) do if one == wanted then return true end end
  return false
end
-- The last lines of what a command said, for a message.
local function tail(text)
  local all, shown = lines(text), {}
  for i = math.max(1, #all - 4), #all do if all[i] ~= '' then shown[#shown + 1] = '    ' .. all[i] end end
  return #shown > 0 and '\n' .. table.concat(shown, '\n') or ''
end

return { readFile = readFile, writeFile = writeFile, quote = quote, escape = escape, html = html, lines = lines, split = split, contains = contains, tail = tail }
