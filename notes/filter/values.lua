-- values.lua - the directive .value: one number or word out of the JSON that a command prints.

local page = require 'filter.page'
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local numbers = require 'filter.numbers'
local shell = require 'filter.shell'
local commands = require 'filter.commands'
local checkAttributes = require('filter.directives').checkAttributes
local language, leads, work = page.language, page.leads, page.work
local readFile, quote, escape, lines, contains, tail = text.readFile, text.quote, text.escape, text.lines, text.contains, text.tail
local localize, formatNumber, percentSign, record = numbers.localize, numbers.formatNumber, numbers.percentSign, numbers.record

-- What a command of .value printed, from the first time it ran since the last .run. Returns nil on failure.
local cache = {}
local function valueFile(command)
  local key = commands.count() .. '\t' .. command
  if cache[key] ~= nil then return cache[key] end
  local index = work .. '/.values/index'
  cache[key] = false
  if leads then
    os.execute('mkdir -p ' .. quote(work .. '/.values'))
    local count = select(2, (readFile(index) or ''):gsub('\n', '\n')) + 1
    local path = work .. '/.values/' .. count
    local code = shell.run(command, '>' .. quote(path) .. ' 2>' .. quote(path .. '.err'))
    if code >= 124 or readFile(path):match '^%s*$' then
      complain('the command `%s` %s%s%s', command, shell.sayCode(code), code < 124 and ' and printed no JSON' or '', tail(readFile(path .. '.err')))
      path = ''
    end
    local file = assert(io.open(index, 'a'))
    file:write(key:gsub('\n', ' '), '\t', path, '\n')
    file:close()
    cache[key] = path ~= '' and path
  else
    for _, line in ipairs(lines(readFile(index) or '')) do
      local found, path = line:match '^(.*)\t(.-)$'
      if found == key then cache[key] = path ~= '' and path end
    end
  end
  return cache[key]
end

local valueKeys = {}
local function valueSpan(span)
  local a = span.attributes
  local unknown = pandoc.Str '?'
  if not checkAttributes('value', a) then return unknown end
  local digits, scale = tonumber(a.digits or '3'), tonumber(a.scale or '1')
  local as = a.as or ''
  if not digits or digits < 1 or digits > 17 or not scale or not contains({ '', 'percent', '/65535', 'integer', 'byte' }, as) then
    complain('a .value has digits in 1..17, a number for scale, and as="percent", "/65535", "integer" or "byte"')
    return unknown
  end
  valueKeys[#valueKeys + 1] = ('%d %s %s digits=%d scale=%s as=%s'):format(commands.count(), a.json, a.get, digits, a.scale or '1', as)
  local path = valueFile(a.json)
  if not path then return unknown end
  local pipe = assert(io.popen(('jq -r %s %s 2>&1'):format(quote('(' .. a.get .. ') | type, .'), quote(path))))
  local said = lines(pipe:read 'a')
  local ended = pipe:close()
  if not ended then
    complain('jq cannot take %s from what `%s` printed%s', a.get, a.json, tail(table.concat(said, '\n')))
    return unknown
  end
  local kind, text = said[1], said[2]
  if kind == 'null' then
    complain('%s gives null in the JSON of `%s`', a.get, a.json)
    return unknown
  elseif (kind ~= 'number' and kind ~= 'string') or #said ~= 2 then
    complain('%s gives no single number in the JSON of `%s`', a.get, a.json)
    return unknown
  end
  local shown, recorded = escape(text), text
  if kind == 'number' then
    local value = tonumber(text) * scale
    if as == 'percent' then
      shown, recorded = formatNumber(100 * value, digits)
      shown, recorded = shown .. percentSign, recorded .. '%'
    elseif as == '' then shown, recorded = formatNumber(value, digits)
    else
      value = value * (({ ['/65535'] = 65535, byte = 255 })[as] or 1)
      recorded = ('%d'):format(math.floor(value + 0.5))
      shown = localize(recorded, language)
      if as == '/65535' then shown, recorded = shown .. '/65535', recorded .. '/65535' end
    end
  end
  if a.volatile ~= 'true' then record('value', a.json, a.get, recorded) end
  return pandoc.RawInline('html', ('<span class="value" title="%s: %s">%s</span>'):format(escape(a.json), escape(a.get), shown))
end

-- The values so far, each with all that decides what it shows.
return { valueSpan = valueSpan, keys = function() return valueKeys end }
