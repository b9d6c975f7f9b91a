-- pictures.lua - pictures as pages show them, and the figure round what is shown.

local env = require('filter.page').env
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local readFile, writeFile, quote, escape, html = text.readFile, text.writeFile, text.quote, text.escape, text.html

-- Copies a picture into a step's folder as pages show it. Returns false, with a complaint, when there is none.
local function keepPicture(path, shownAs, to)
  if not readFile(path) then
    complain('there is no picture %s; an earlier .run of this chapter must make it', shownAs)
    return false
  end
  if shownAs:match '%.svg$' then
    writeFile(to, readFile(path))
    return true
  end
  local pipe = assert(io.popen(('%s %s %s 2>&1'):format(quote(env 'SCREEN_PICTURE'), quote(path), quote(to))))
  local said = pipe:read 'a'
  if pipe:close() then return true end
  complain('the picture %s cannot be shown: %s', shownAs, said:gsub('%s+$', ''))
  return false
end

local function pictureTag(path, alt)
  local data = readFile(path)
  local pipe = assert(io.popen('base64 -w0 ' .. quote(path)))
  local encoded = pipe:read 'a'
  pipe:close()
  local kind, size = 'svg+xml', ''
  if data:sub(2, 4) ~= 'PNG' then
    local width, height = data:match ' width="(%d+)" height="(%d+)"'
    size = width and (' width="%s" height="%s"'):format(width, height) or ''
  else
    kind, size = 'png', (' width="%d" height="%d"'):format(string.unpack('>I4I4', data, 17))
  end
  return ('<img alt="%s"%s src="data:image/%s;base64,%s">'):format(escape(alt), size, kind, encoded)
end

-- The caption of a figure: what stands inside its directive.
local function caption(div)
  local content = {}
  for i, block in ipairs(div.content) do content[i] = block.t == 'Para' and #div.content == 1 and pandoc.Plain(block.content) or block end
  return content
end
local function figure(class, before, div, after)
  local made = { html('<figure class="' .. class .. '">' .. before) }
  local content = caption(div)
  if #content > 0 then
    made[#made + 1] = html '<figcaption>'
    for _, block in ipairs(content) do made[#made + 1] = block end
    made[#made + 1] = html '</figcaption>'
  end
  made[#made + 1] = html((after or '') .. '</figure>')
  return made
end

return { keepPicture = keepPicture, pictureTag = pictureTag, figure = figure }
