-- listings.lua - the directives .code and .scene: parts of files, as they stand there.

local page = require 'filter.page'
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local step = require('filter.steps').step
local work, words = page.work, page.words
local readFile, escape, html, lines = text.readFile, text.escape, text.html, text.lines

-- First and last line of a C function, the comment above it included; nil when it is not there.
local function findFunction(all, wanted)
  for i, line in ipairs(all) do
    if line:match '^[%a_]' and line:match('%f[%w_]' .. wanted .. '%s*%(') then
      -- A definition has a brace before any semicolon.
      local last = i
      while all[last] and not all[last]:find '[{;]' do last = last + 1 end
      local brace = all[last] and all[last]:find '{'
      local semicolon = all[last] and all[last]:find ';'
      if brace and not (semicolon and semicolon < brace) then
        while all[last] and not all[last]:match '}%s*$' or all[last] and all[last]:match '^%s' do last = last + 1 end
        if not all[last] then return nil end
        local first = i
        if first > 1 and all[first - 1]:match '%*/%s*$' then
          repeat first = first - 1 until first <= 1 or all[first]:match '^%s*/%*'
        else
          while first > 1 and all[first - 1]:match '^//' do first = first - 1 end
        end
        return first, last
      end
    end
  end
end

local function findMarker(all, text, what, file)
  local found
  for i, line in ipairs(all) do
    if line:find(text, 1, true) then
      if found then complain('%s="%s" stands in %s more than once, in lines %d and %d', what, text, file, found, i) return nil end
      found = i
    end
  end
  if not found then complain('%s="%s" is not in %s', what, text, file) end
  return found
end

local codeLanguages = { c = 'c', h = 'c', yaml = 'yaml', sh = 'sh', lua = 'lua', js = 'javascript', awk = 'awk', py = 'python', mk = 'makefile' }
local function codeFigure(class, path, first, text)
  local place = first and ('%s, %s %d'):format(path, words.line, first) or path
  return { html(('<div class="listing %s"><p class="place"><code>%s</code></p>'):format(class, escape(place))),
    pandoc.CodeBlock(text, pandoc.Attr('', { codeLanguages[path:match '%.(%w+)$' or ''] or 'default' })), html '</div>' }
end

local function codeDiv(div)
  local a = div.attributes
  step(('code %s %s %s %s'):format(a.file, a['function'] or '', a.from or '', a.to or ''), function() return true end)
  local text = readFile(work .. '/' .. a.file)
  if not text then complain('there is no file %s', a.file) return {} end
  local all = lines(text)
  local first, last
  if a['function'] then
    first, last = findFunction(all, (a['function']:gsub('%p', '%%%0')))
    if not first then complain("the function '%s' is not in %s", a['function'], a.file) return {} end
  elseif a.from and a.to then
    first, last = findMarker(all, a.from, 'from', a.file), findMarker(all, a.to, 'to', a.file)
    if not first or not last then return {} end
    if last < first then complain('in %s, to="%s" comes before from="%s"', a.file, a.to, a.from) return {} end
  else
    complain('the directive .code needs function="...", or from="..." and to="..."')
    return {}
  end
  -- Take away the indentation that all lines share.
  local part, indent = table.move(all, first, last, 1, {}), 99
  for _, line in ipairs(part) do if line:find '%S' then indent = math.min(indent, #line:match '^%s*') end end
  for i, line in ipairs(part) do part[i] = line:sub(indent + 1) end
  return codeFigure('code', a.file, first, table.concat(part, '\n'))
end

local function sceneDiv(div)
  local file = div.attributes.file
  step('scene ' .. file, function() return true end)
  local text = readFile(work .. '/' .. file)
  if not text then complain('there is no scene %s', file) return {} end
  local all, first = lines(text), 1
  while all[first] and (all[first]:match '^%s*#' or all[first]:match '^%s*$') do first = first + 1 end
  return codeFigure('scene', file, nil, table.concat(all, '\n', first))
end

return { codeDiv = codeDiv, sceneDiv = sceneDiv }
