-- notes.lua - turns the directives of a chapter into what a reader sees (a filter for pandoc 2.17 or later).
--
-- A chapter is walked once, from its first line to its last, and each directive acts when it is met: commands
-- run, pictures are taken as they are at that moment. So a page shows what a reader who types its commands in
-- order gets. The first language of a chapter does this and keeps what came out below .steps in the chapter's
-- work folder; every other language must hold the same directives and shows the same results.
-- Nothing stops at the first mistake: each goes to the file of errors, and the driver ends the build.
--
-- make-notes.sh calls it, with these in the environment:
--   NOTES_MODE      list: write the chapter's title and scenes to NOTES_LIST; page: make the page
--   NOTES_FILE      the chapter's file, as messages name it
--   NOTES_NAME, NOTES_LANGUAGE     03-lambert, en
--   NOTES_LEADS     yes when this language runs the commands
--   NOTES_WORK      the folder in which commands run
--   NOTES_PAGES     the list of all pages: language, name, title, summary, scene, separated by tabs
--   NOTES_COMPARED  what `compare` said of each scene, and NOTES_PICTURES the folder with its pictures
--   NOTES_SCREEN_PICTURE           the program of screen_picture.c
--   NOTES_NUMBERS, NOTES_ERRORS    files to write

local env = function(name) return os.getenv('NOTES_' .. name) or '' end
local language, name, work = env 'LANGUAGE', env 'NAME', env 'WORK'
local leads = env 'LEADS' == 'yes'
local timeLimit = 120 -- seconds for one command

-- The words that the build puts into a page.
local words = ({
  en = {
    exercise = 'Exercise', answer = 'Answer', difference = 'Difference', command = 'Compare them yourself',
    largest = 'Largest difference', flip = 'FLIP', rmse = 'RMSE', identical = 'Identical pixels',
    agree = 'within the scene’s limits', differ = 'beyond the scene’s limits', slider = 'Slider between %s and %s',
    differenceAlt = 'Where the two differ, in false colours; the largest difference is %s.',
    copy = 'Copy', copied = 'Copied', output = 'prints', line = 'line', contents = 'On this page', chapters = 'Chapters',
    previous = 'Previous', next = 'Next', skip = 'Skip to the text', dark = 'Dark', notes = 'The notes',
    languages = 'Language', colon = ': ', chapter = 'Chapter', runs = 'Run', from = 'from', to = 'to',
    footer = 'Made by make notes: every picture and every number on this page came from the commands beside it. It needs no network.',
  },
  fr = {
    exercise = 'Exercice', answer = 'Réponse', difference = 'Différence', command = 'Comparez vous-même',
    largest = 'Plus grande différence', flip = 'FLIP', rmse = 'RMSE', identical = 'Pixels identiques',
    agree = 'dans les limites de la scène', differ = 'hors des limites de la scène', slider = 'Curseur entre %s et %s',
    differenceAlt = 'Là où les deux diffèrent, en fausses couleurs\u{202F}; la plus grande différence est %s.',
    copy = 'Copier', copied = 'Copié', output = 'affiche', line = 'ligne', contents = 'Sur cette page', chapters = 'Chapitres',
    previous = 'Précédent', next = 'Suivant', skip = 'Aller au texte', dark = 'Sombre', notes = 'Les notes de cours',
    languages = 'Langue', colon = '\u{A0}: ', chapter = 'Chapitre', runs = 'Commandes', from = 'de', to = 'à',
    footer = 'Page faite par make notes\u{A0}: chacune de ses images et chacun de ses nombres viennent des commandes placées à côté. Elle n’a pas besoin du réseau.',
  },
})[language]

-- --- Small tools ------------------------------------------------------------------------------------------

local failed = false
local function complain(text, ...)
  failed = true
  local file = assert(io.open(env 'ERRORS', 'a'))
  file:write(env 'FILE', ': ', select('#', ...) > 0 and text:format(...) or text, '\n')
  file:close()
end

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

-- Runs one line as a shell in the work folder would; returns its exit code.
local function shell(line, redirection)
  local script = os.tmpname()
  writeFile(script, line .. '\n')
  local _, kind, code = os.execute(('cd %s && timeout -k 5 %d sh %s </dev/null %s'):format(quote(work), timeLimit, quote(script), redirection))
  os.remove(script)
  return kind == 'signal' and 128 + code or code
end
local function sayCode(code)
  if code == 124 then return ('took more than %d seconds'):format(timeLimit) end
  return ('ended with exit code %d'):format(code)
end

local numbers = {}
local function record(directive, command, path, value)
  if not leads then return end
  local cells = { name, directive, command, path, value }
  for i, cell in ipairs(cells) do cells[i] = cell:find '[,"\n]' and '"' .. cell:gsub('"', '""') .. '"' or cell end
  numbers[#numbers + 1] = table.concat(cells, ',')
end

-- --- Numbers as people write them -------------------------------------------------------------------------

local narrowSpace = '\u{202F}'
-- A plain decimal, such as -12345.60, in the page's language.
local function localize(text, inLanguage)
  local sign, whole, rest = text:match '^(%-?)(%d+)(.*)$'
  if not whole then return text end
  if #whole > 4 then
    whole = whole:reverse():gsub('(%d%d%d)', '%1\0'):reverse():gsub('^%z', '')
    whole = whole:gsub('%z', inLanguage == 'fr' and narrowSpace or ',')
  end
  if inLanguage == 'fr' then rest = rest:gsub('^%.', ',') end
  return (sign == '-' and inLanguage and '−' or sign) .. whole .. rest
end

-- A value with so many significant digits: as text for a page, and as the text that is recorded.
local function formatNumber(value, digits)
  local mantissa, exponent = ('%.' .. (digits - 1) .. 'e'):format(value):match '^(.-)e(.*)$'
  exponent = tonumber(exponent)
  if value == 0 then return localize('0', language), '0' end
  if exponent < -4 or exponent > 14 then
    local superscript = tostring(exponent):gsub('-', '−')
    return localize(mantissa, language) .. ' × 10<sup>' .. superscript .. '</sup>', mantissa .. 'e' .. exponent
  end
  local text
  if value == math.floor(value) and exponent < digits then text = ('%d'):format(value)
  else
    text = ('%.' .. math.max(0, digits - 1 - exponent) .. 'f'):format(tonumber(mantissa .. 'e' .. exponent))
  end
  return localize(text, language), text
end
local percentSign = language == 'fr' and narrowSpace .. '%' or '%'

-- A share of 1 as percent; all and nothing are said only when that is so.
local function formatShare(part, whole)
  local percent = 100 * part / whole
  local text = ('%.2f'):format(percent)
  if part == whole then text = '100'
  elseif part == 0 then text = '0'
  elseif text == '100.00' then text = '99.99'
  elseif text == '0.00' then text = '0.01' end
  return localize(text, language) .. percentSign, text .. '%'
end

-- --- Steps: what the first language does, the others repeat ------------------------------------------------

local stepCount, inStep = 0, true

-- Runs act(folder) for a directive that is described by key, or finds the folder of the one that the first
-- language did in its place. Returns that folder, or nil when there is nothing to show.
local function step(key, act)
  stepCount = stepCount + 1
  local folder = work .. '/.steps/' .. stepCount
  if leads then
    os.execute('mkdir -p ' .. quote(folder))
    writeFile(folder .. '/key', key)
    if act(folder) then return folder end
    writeFile(folder .. '/failed', '')
    return nil
  end
  if not inStep then return nil end
  local wanted = readFile(folder .. '/key')
  if wanted ~= key then
    inStep = false
    complain('its directives are not those of the other language: number %d is\n    %s\n  but there it is\n    %s', stepCount, key, wanted or '(none)')
    return nil
  end
  if readFile(folder .. '/failed') then return nil end
  return folder
end

-- The attributes and classes that each directive has; those with ! must be there.
local directives = {
  pair = 'scene! alt!',
  picture = 'file! alt!',
  slider = 'a! b! a-label! b-label! alt! volatile',
  code = 'file! function from to',
  exercise = '',
  answer = '',
  plot = 'csv! x! y! xlog ylog x-label y-label y-labels alt! volatile',
  table = 'csv! volatile',
  scene = 'file!',
  chapters = '',
  note = '',
  value = 'json! get! digits scale as volatile',
  run = 'exit',
}
local function checkAttributes(directive, attributes)
  local good = true
  local known = {}
  for word in directives[directive]:gmatch '%S+' do
    local key = word:gsub('!', '')
    known[key] = true
    if word:find '!' and (attributes[key] or ''):match '^%s*$' then
      complain('the directive .%s needs %s="..."', directive, key)
      good = false
    end
  end
  for key in pairs(attributes) do
    if not known[key] then
      complain('the directive .%s has no attribute %q', directive, key)
      good = false
    end
  end
  return good
end

-- --- Commands -----------------------------------------------------------------------------------------------

local epoch = 0 -- how many .run came before: what a command of .value is cached for

-- The commands of a block: a line each, or several that end in a backslash; comments are for the reader.
local function commandsOf(text)
  local commands = {}
  for _, line in ipairs(lines((text:gsub('\\\n', '\\\0')))) do
    line = line:gsub('%z', '\n')
    if not line:match '^%s*#' and not line:match '^%s*$' then commands[#commands + 1] = line end
  end
  return commands
end

local function commandBox(text, label)
  return ('<div class="command"><span class="command-label">%s</span><code>%s</code><button type="button" class="copy js-only">%s</button></div>')
    :format(label, escape(text), words.copy)
end

local function runBlock(block)
  local attributes = block.attributes
  if not checkAttributes('run', attributes) then return {} end
  epoch = epoch + 1
  local expected = tonumber(attributes.exit or '0')
  local shows = contains(block.classes, 'output')
  local commands = commandsOf(block.text)
  if #commands == 0 then complain('a block .run has no command') return {} end
  local folder = step('run exit=' .. tostring(expected) .. (shows and ' output ' or ' ') .. table.concat(commands, '; '), function(folder)
    writeFile(folder .. '/output', '')
    for i, command in ipairs(commands) do
      local wanted = i == #commands and expected or 0
      local before = #readFile(folder .. '/output')
      local code = shell(command, '>>' .. quote(folder .. '/output') .. ' 2>&1')
      if code ~= wanted then
        complain('the command `%s` %s, not %d%s', command, sayCode(code), wanted, tail(readFile(folder .. '/output'):sub(before + 1)))
        return false
      end
    end
    return true
  end)
  local made = { html '<div class="run">', html('<button type="button" class="copy js-only">' .. words.copy .. '</button>'),
    pandoc.CodeBlock(block.text, pandoc.Attr('', { 'sh' })) }
  if shows and folder then
    local output = readFile(folder .. '/output')
    if output:match '^%s*$' then complain('the commands `%s` print nothing; leave the class .output away', commands[1]) end
    if not contains(block.classes, 'volatile') then
      for i, line in ipairs(lines(output)) do
        if line:find '%d' then record('output', commands[#commands], tostring(i), line) end
      end
    end
    made[#made + 1] = html('<pre class="output" tabindex="0"><code>' .. escape(output) .. '</code></pre>')
  end
  made[#made + 1] = html '</div>'
  return made
end

-- What a command of .value printed, from the first time it ran since the last .run. Returns nil on failure.
local cache = {}
local function valueFile(command)
  local key = epoch .. '\t' .. command
  if cache[key] ~= nil then return cache[key] end
  local index = work .. '/.values/index'
  cache[key] = false
  if leads then
    os.execute('mkdir -p ' .. quote(work .. '/.values'))
    local count = select(2, (readFile(index) or ''):gsub('\n', '\n')) + 1
    local path = work .. '/.values/' .. count
    local code = shell(command, '>' .. quote(path) .. ' 2>' .. quote(path .. '.err'))
    if code >= 124 or readFile(path):match '^%s*$' then
      complain('the command `%s` %s%s%s', command, sayCode(code), code < 124 and ' and printed no JSON' or '', tail(readFile(path .. '.err')))
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
  valueKeys[#valueKeys + 1] = ('%d %s %s digits=%d scale=%s as=%s'):format(epoch, a.json, a.get, digits, a.scale or '1', as)
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

-- --- Pictures -----------------------------------------------------------------------------------------------

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
  if data:sub(2, 4) == 'PNG' then
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

-- Two pictures with a slider between them, their difference, and numbers: label, value and perhaps a mark.
local function slider(first, second, firstLabel, secondLabel, difference, alt, facts)
  local cells = {}
  for i, fact in ipairs(facts) do
    cells[i] = ('<div><dt>%s</dt><dd>%s</dd></div>'):format(fact[1], fact[2])
  end
  local side = '<div class="side %s">%s<span class="label">%s</span></div>'
  return table.concat {
    '<div class="pictures"><div class="wiper"><div class="stage">',
    side:format('first', pictureTag(first, firstLabel .. words.colon .. alt), escape(firstLabel)),
    side:format('second', pictureTag(second, secondLabel .. words.colon .. alt), escape(secondLabel)),
    '</div>',
    ('<label class="slide js-only"><span class="hidden">%s</span><input type="range" min="0" max="100" value="50"></label></div>')
      :format(escape(words.slider:format(firstLabel, secondLabel))),
    ('<div class="map">%s<span class="label">%s</span></div>'):format(pictureTag(difference, words.differenceAlt:format(facts[1][2]:gsub('<.->', ''))), words.difference),
    '</div><dl class="facts">', table.concat(cells), '</dl>',
  }
end

-- The numbers that stand below two pictures. most is 65535 or 255, what the largest sample is.
local function factsOf(result, most, directive, command, isRecorded)
  local largest = ('%d/%d'):format(math.floor(result.max * most + 0.5), most)
  local rmse, rmseRecorded = formatNumber(result.rmse, 2)
  local flip, flipRecorded = formatNumber(result.flip, 2)
  local share, shareRecorded = formatShare(result.identical, result.pixels)
  if isRecorded then
    record(directive, command, '.max_difference', largest)
    record(directive, command, '.rmse', rmseRecorded)
    record(directive, command, '.flip', flipRecorded)
    record(directive, command, '.identical_pixels', shareRecorded)
  end
  return { { words.largest, localize(largest, language) }, { words.rmse, rmse }, { words.flip, flip }, { words.identical, share } }
end

local compared
local function comparedScene(scene)
  if not compared then
    compared = {}
    for _, line in ipairs(lines(readFile(env 'COMPARED') or '')) do
      local c = split(line, '\t')
      compared[c[1]] = { pass = c[2] == 'true', max = tonumber(c[3]), rmse = tonumber(c[4]), flip = tonumber(c[5]), identical = tonumber(c[6]),
        pixels = tonumber(c[7]), ours = c[8], povray = c[9], difference = c[10], error = c[11] ~= '' and c[11] or nil }
    end
  end
  return compared[scene]
end

local function pairDiv(div)
  local scene, alt = div.attributes.scene, div.attributes.alt
  local folder = step('pair ' .. scene, function(folder)
    if not readFile(work .. '/' .. scene) then complain('there is no scene %s', scene) return false end
    local result = comparedScene(scene)
    if not result or result.error then
      complain('the scene %s could not be compared: %s', scene, result and result.error or 'the comparison says nothing of it')
      return false
    end
    for _, kind in ipairs { 'ours', 'povray', 'difference' } do
      if not keepPicture(env 'PICTURES' .. '/' .. result[kind], result[kind], folder .. '/' .. kind .. '.png') then return false end
    end
    return true
  end)
  if not folder then return {} end
  local command = 'build/eclairage compare ' .. scene
  local result = comparedScene(scene)
  local facts = factsOf(result, 65535, 'pair', command, true)
  local verdict = result.pass and 'agree' or 'differ'
  facts[1][2] = facts[1][2] .. (' <span class="mark %s" role="img" aria-label="%s" title="%s"></span>'):format(verdict, words[verdict], words[verdict])
  return figure('compared', slider(folder .. '/ours.png', folder .. '/povray.png', 'Éclairage', 'POV-Ray', folder .. '/difference.png', alt, facts),
    div, commandBox(command, words.command))
end

local function sliderDiv(div)
  local a = div.attributes
  local command = ('build/eclairage diff %s %s'):format(a.a, a.b)
  local folder = step('slider ' .. a.a .. ' ' .. a.b, function(folder)
    if not keepPicture(work .. '/' .. a.a, a.a, folder .. '/a.png') or not keepPicture(work .. '/' .. a.b, a.b, folder .. '/b.png') then return false end
    local code = shell(('build/eclairage diff --quiet --json %s %s -o %s'):format(quote(a.a), quote(a.b), quote(folder .. '/map.png')),
      '>' .. quote(folder .. '/json') .. ' 2>' .. quote(folder .. '/error'))
    if code > 1 then
      complain('`%s` %s%s', command, sayCode(code), tail(readFile(folder .. '/error')))
      return false
    end
    local depth = readFile(work .. '/' .. a.a):byte(25)
    os.execute(('jq -r "[.max_difference, .rmse, .flip, .identical_pixels, .pixels, %d] | @tsv" %s >%s'):format(depth == 16 and 65535 or 255, quote(folder .. '/json'), quote(folder .. '/tsv')))
    return keepPicture(folder .. '/map.png', 'of the difference', folder .. '/difference.png')
  end)
  if not folder then return {} end
  local c = {}
  for i, cell in ipairs(split(lines(readFile(folder .. '/tsv'))[1], '\t')) do c[i] = tonumber(cell) end
  local facts = factsOf({ max = c[1], rmse = c[2], flip = c[3], identical = c[4], pixels = c[5] }, c[6], 'slider', command, a.volatile ~= 'true')
  return figure('compared', slider(folder .. '/a.png', folder .. '/b.png', a['a-label'], a['b-label'], folder .. '/difference.png', a.alt, facts),
    div, commandBox(command, words.command))
end

local function pictureDiv(div)
  local file = div.attributes.file
  local folder = step('picture ' .. file, function(folder) return keepPicture(work .. '/' .. file, file, folder .. '/picture') end)
  if not folder then return {} end
  return figure('picture', '<div class="frame">' .. pictureTag(folder .. '/picture', div.attributes.alt) .. '</div>', div)
end

-- --- Code ---------------------------------------------------------------------------------------------------

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

-- --- Tables and charts --------------------------------------------------------------------------------------

-- The rows of a CSV file without line breaks inside its cells; the first is the header.
local function readCsv(path, shownAs)
  local text = readFile(path)
  if not text then complain('there is no file %s; an earlier .run of this chapter must make it', shownAs) return nil end
  local rows = {}
  for _, line in ipairs(lines(text)) do
    if line ~= '' then
      local row, rest = {}, line .. ','
      while rest ~= '' do
        local cell, after = rest:match '^"(.-)",(.*)$'
        while cell and select(2, cell:gsub('"', '')) % 2 == 1 do -- a doubled quote was taken for the end
          local more, afterMore = after:match '^(.-)",(.*)$'
          if not more then break end
          cell, after = cell .. '",' .. more, afterMore
        end
        if not cell then cell, after = rest:match '^(.-),(.*)$' end
        row[#row + 1] = cell:gsub('""', '"')
        rest = after
      end
      if rows[1] and #row ~= #rows[1] then complain('%s: line %d has %d cells, not %d as the header', shownAs, #rows + 1, #row, #rows[1]) return nil end
      rows[#rows + 1] = row
    end
  end
  if #rows < 2 then complain('%s has no rows', shownAs) return nil end
  return rows
end

local function csvStep(key, file)
  local folder = step(key, function(folder)
    local text = readFile(work .. '/' .. file)
    if not text then complain('there is no file %s; an earlier .run of this chapter must make it', file) return false end
    writeFile(folder .. '/csv', text)
    return true
  end)
  return folder and readCsv(folder .. '/csv', file)
end

local function tableDiv(div)
  local file = div.attributes.csv
  local rows = csvStep('table ' .. file, file)
  if not rows then return {} end
  local out, isNumber = {}, {}
  for column = 1, #rows[1] do
    isNumber[column] = true
    for i = 2, #rows do isNumber[column] = isNumber[column] and (rows[i][column] == '' or tonumber(rows[i][column]) ~= nil) end
  end
  for i, row in ipairs(rows) do
    local cells = {}
    for column, cell in ipairs(row) do
      local class = isNumber[column] and ' class="number"' or ''
      local shown = escape(cell)
      if i > 1 and isNumber[column] and language == 'fr' then shown = shown:gsub('%.', ',') end
      cells[column] = i == 1 and ('<th scope="col"%s>%s</th>'):format(class, shown) or ('<td%s>%s</td>'):format(class, shown)
    end
    out[i] = '<tr>' .. table.concat(cells) .. '</tr>'
    if i > 1 and div.attributes.volatile ~= 'true' then record('table', file, tostring(i - 1), table.concat(row, ' ')) end
  end
  return figure('table', '<div class="scroll" tabindex="0"><table><thead>' .. out[1] .. '</thead><tbody>' .. table.concat(out, '', 2) .. '</tbody></table></div>', div)
end

-- An axis from the data's range: place(value) in 0..1, and ticks of value and text.
local function makeAxis(least, most, isLog, include)
  local axis = { ticks = {} }
  if isLog then
    local low, high = math.floor(math.log(least, 10) + 1e-9), math.ceil(math.log(most, 10) - 1e-9)
    if high == low then high = low + 1 end
    axis.place = function(value) return (math.log(value, 10) - low) / (high - low) end
    local every = math.ceil((high - low) / 8)
    for power = low, high, every do
      local text = (power >= -2 and power <= 3) and localize(('%.10g'):format(10 ^ power), language)
        or ('10<tspan dy="-5" font-size="9">%s</tspan>'):format(tostring(math.tointeger(power) or power):gsub('-', '−'))
      axis.ticks[#axis.ticks + 1] = { 10.0 ^ power, text }
    end
    return axis
  end
  if include then least, most = math.min(least, 0), math.max(most, 0) end
  if least == most then least, most = least - 1, most + 1 end
  local rough = (most - least) / 5
  local size = 10.0 ^ math.floor(math.log(rough, 10))
  for _, factor in ipairs { 1, 2, 5, 10 } do
    if size * factor >= rough * 0.999 then size = size * factor break end
  end
  local low, high = math.floor(least / size + 1e-9), math.ceil(most / size - 1e-9)
  axis.place = function(value) return (value / size - low) / (high - low) end
  for i = low, high do axis.ticks[#axis.ticks + 1] = { i * size, localize(('%.6g'):format(i * size), language) } end
  return axis
end

local function plotDiv(div)
  local a = div.attributes
  local names = split(a.y, ',')
  local labels = a['y-labels'] and split(a['y-labels'], ',') or names
  local rows = csvStep(('plot %s %s %s %s %s'):format(a.csv, a.x, a.y, a.xlog or '', a.ylog or ''), a.csv)
  if not rows then return {} end
  if #labels ~= #names or #names > 6 then complain('the .plot of %s needs as many y-labels as columns in y, at most 6', a.csv) return {} end
  local columns = {}
  for i, cell in ipairs(rows[1]) do columns[cell:match '^%s*(.-)%s*$'] = i end
  local xlog, ylog = a.xlog == 'true', a.ylog == 'true'
  for _, wanted in ipairs { a.x, table.unpack(names) } do
    if not columns[wanted] then complain('%s has no column %q', a.csv, wanted) return {} end
  end

  -- Collect the points that have a place; a logarithm of nothing has none.
  local series, range = {}, { x = { math.huge, -math.huge }, y = { math.huge, -math.huge } }
  local function extend(which, value) which[1], which[2] = math.min(which[1], value), math.max(which[2], value) end
  for s, column in ipairs(names) do
    series[s] = {}
    local own = { math.huge, -math.huge }
    for i = 2, #rows do
      local cells = { rows[i][columns[a.x]], rows[i][columns[column]] }
      local x, y = tonumber(cells[1]), tonumber(cells[2])
      for c, cell in ipairs(cells) do
        if not tonumber(cell) and not contains({ '', 'nan', '-nan', 'inf', '-inf' }, cell) then
          complain('%s: line %d, "%s" in column %s is not a number', a.csv, i, cell, c == 1 and a.x or column)
          return {}
        end
      end
      if x and y and (not xlog or x > 0) and (not ylog or y > 0) then
        series[s][#series[s] + 1] = { x, y }
        extend(range.x, x) extend(range.y, y) extend(own, y)
      else series[s][#series[s] + 1] = false end
    end
    if own[1] > own[2] then complain('%s: nothing of column %s can be drawn', a.csv, column) return {} end
    if a.volatile ~= 'true' then
      record('plot', a.csv, column .. ' least', ('%.4g'):format(own[1]))
      record('plot', a.csv, column .. ' most', ('%.4g'):format(own[2]))
    end
  end

  -- Draw the grid, then the lines: each has its colour, its dashes and its marks.
  local xAxis, yAxis = makeAxis(range.x[1], range.x[2], xlog), makeAxis(range.y[1], range.y[2], ylog, true)
  local left, right, top, bottom = 62, 708, 14, 318
  local px = function(value) return left + (right - left) * xAxis.place(value) end
  local py = function(value) return bottom - (bottom - top) * yAxis.place(value) end
  local out = {}
  local function put(text, ...) out[#out + 1] = text:format(...) end
  for _, tick in ipairs(yAxis.ticks) do
    put('<line class="grid" x1="%d" x2="%d" y1="%.1f" y2="%.1f"/><text x="%d" y="%.1f" text-anchor="end">%s</text>', left, right, py(tick[1]), py(tick[1]), left - 8, py(tick[1]) + 4, tick[2])
  end
  for _, tick in ipairs(xAxis.ticks) do
    put('<line class="grid" x1="%.1f" x2="%.1f" y1="%d" y2="%d"/><text x="%.1f" y="%d" text-anchor="middle">%s</text>', px(tick[1]), px(tick[1]), top, bottom, px(tick[1]), bottom + 20, tick[2])
  end
  put('<line class="axis" x1="%d" x2="%d" y1="%d" y2="%d"/>', left, right, bottom, bottom)
  if a['x-label'] then put('<text class="axis-label" x="%d" y="%d" text-anchor="middle">%s</text>', (left + right) // 2, bottom + 44, escape(a['x-label'])) end
  if a['y-label'] then put('<text class="axis-label" transform="translate(14 %d) rotate(-90)" text-anchor="middle">%s</text>', (top + bottom) // 2, escape(a['y-label'])) end
  local marks = {
    '<circle class="mark-%d" cx="%.1f" cy="%.1f" r="3.5"/>',
    '<rect class="mark-%d" x="-3.2" y="-3.2" width="6.4" height="6.4" transform="translate(%.1f %.1f)"/>',
    '<path class="mark-%d" d="M0 -4.4L4.2 3.2H-4.2Z" transform="translate(%.1f %.1f)"/>',
  }
  for s, points in ipairs(series) do
    local path, pen = {}, 'M'
    for _, point in ipairs(points) do
      if point then
        path[#path + 1] = ('%s%.1f %.1f'):format(pen, px(point[1]), py(point[2]))
        pen = 'L'
      else pen = 'M' end
    end
    put('<path class="line-%d" d="%s"/>', s, table.concat(path))
    if #points <= 40 then
      for _, point in ipairs(points) do if point then put(marks[(s - 1) % 3 + 1], s, px(point[1]), py(point[2])) end end
    end
  end
  local legend = {}
  for s, label in ipairs(labels) do
    legend[s] = ('<li><svg viewBox="0 0 36 12" width="36" height="12" aria-hidden="true"><path class="line-%d" d="M1 6H35"/>%s</svg> %s</li>')
      :format(s, marks[(s - 1) % 3 + 1]:format(s, 18, 6), escape(label:match '^%s*(.-)%s*$'))
  end
  return figure('plot', (#names > 1 and '<ul class="legend">' .. table.concat(legend) .. '</ul>' or '')
    .. ('<svg class="chart" viewBox="0 0 720 %d" role="img" aria-label="%s">%s</svg>'):format(a['x-label'] and 370 or 346, escape(a.alt), table.concat(out)), div)
end

-- --- Exercises ----------------------------------------------------------------------------------------------

local chapterNumber = tonumber(name:match '^%d+')
local exercises = 0
local function exerciseDiv(div)
  exercises = exercises + 1
  step('exercise', function() return true end)
  local number = (chapterNumber and chapterNumber .. '.' or '') .. exercises
  local made = { html(('<section class="exercise" aria-labelledby="exercise-%d"><p class="exercise-title" id="exercise-%d">%s %s</p>'):format(exercises, exercises, words.exercise, number)) }
  local answers = 0
  for _, block in ipairs(div.content) do
    if block.t == 'Div' and contains(block.classes, 'answer') then answers = answers + 1 end
  end
  if answers ~= 1 then complain('exercise %s has %d answers, not one', number, answers) end
  -- What is returned is not walked again, only what is inside of it: hence a div around the directives.
  made[#made + 1] = pandoc.Div(div.content, pandoc.Attr('', { 'exercise-text' }))
  made[#made + 1] = html '</section>'
  return made
end
local function answerDiv(div)
  return { html('<details class="answer"><summary>' .. words.answer .. '</summary>'), pandoc.Div(div.content, pandoc.Attr('', { 'answer-text' })), html '</details>' }
end

-- --- The pages ----------------------------------------------------------------------------------------------

local pages = {} -- of this language, in order
local titles = {} -- titles[language][name]
for _, line in ipairs(lines(readFile(env 'PAGES') or '')) do
  local c = split(line, '\t')
  if #c >= 5 then
    local page = { language = c[1], name = c[2], title = c[3], summary = c[4], thumbnail = c[6] or '' }
    titles[page.language] = titles[page.language] or {}
    titles[page.language][page.name] = page
    if page.language == language and page.name ~= 'index' then pages[#pages + 1] = page end
  end
end
local function numberOf(page) return page.name:match '^0*(%d+)' or '' end

local function chapterCards()
  local cards = {}
  for i, page in ipairs(pages) do
    local picture = page.thumbnail ~= '' and readFile(page.thumbnail) and pictureTag(page.thumbnail, '') or ''
    cards[i] = ('<li><a href="%s.html"><span class="thumb">%s</span><span class="card-text"><span class="card-number">%s %s</span><b>%s</b><span class="soft">%s</span></span></a></li>')
      :format(escape(page.name), picture, words.chapter, numberOf(page), escape(page.title), escape(page.summary))
  end
  return html('<ol class="cards">' .. table.concat(cards) .. '</ol>')
end

local hasCards = false
local divs = { pair = pairDiv, picture = pictureDiv, slider = sliderDiv, code = codeDiv, exercise = exerciseDiv, answer = answerDiv, plot = plotDiv,
  table = tableDiv, scene = sceneDiv }
local function div(element)
  local class = element.classes[1]
  if not class then return nil end
  if class == 'chapters' then hasCards = true return chapterCards() end
  if class == 'note' then return nil end
  if not divs[class] then complain('there is no directive .%s', class) return nil end
  if not checkAttributes(class, element.attributes) then return {} end
  return divs[class](element)
end

local function link(element)
  local target = element.target
  if target:match '^https?://' or target:match '^#' then return nil end
  local page, anchor = target:match '^([%w-]+)%.%w+(#?.*)$'
  if page and titles[language][page] and target:match '%.md%f[#%z]' or page and titles[language][page] and target:match '%.html%f[#%z]' then
    element.target = page .. '.html' .. anchor
    return element
  end
  complain('the link to %s leads nowhere: a link is to https://..., to #a-section or to another chapter, such as 04-phong.md', target)
end

local function finish(document)
  -- Hold what the languages have in common against each other.
  table.sort(valueKeys)
  local keys = table.concat(valueKeys, '\n')
  if leads then
    os.execute('mkdir -p ' .. quote(work .. '/.steps'))
    writeFile(work .. '/.steps/values', keys)
    writeFile(work .. '/.steps/count', tostring(stepCount))
    writeFile(env 'NUMBERS', #numbers > 0 and table.concat(numbers, '\n') .. '\n' or '')
  elseif inStep then
    local count = tonumber(readFile(work .. '/.steps/count') or '')
    if count ~= stepCount then complain('it has %d directives, the other language %s', stepCount, tostring(count)) end
    if readFile(work .. '/.steps/values') ~= keys then
      local theirs = {}
      for _, key in ipairs(lines(readFile(work .. '/.steps/values') or '')) do theirs[key] = (theirs[key] or 0) + 1 end
      for _, key in ipairs(valueKeys) do
        if not theirs[key] or theirs[key] == 0 then complain('the other language has no .value %s (the first number counts the .run before)', key) else theirs[key] = theirs[key] - 1 end
      end
      for key, left in pairs(theirs) do if left > 0 and key ~= '' then complain('the .value %s of the other language is missing', key) end end
    end
  end

  -- Tell the template where the page stands.
  local meta = document.meta
  for word, text in pairs(words) do meta['word-' .. word:lower()] = text end
  meta.lang = language
  meta.number = chapterNumber and tostring(chapterNumber) or nil
  meta.index = name == 'index' or nil
  local links, here = {}, 0
  for i, page in ipairs(pages) do
    if page.name == name then here = i end
    links[i] = { href = page.name .. '.html', title = page.title, number = numberOf(page), current = page.name == name or nil }
  end
  meta.chapters = #links > 0 and links or nil
  meta.previous = here > 1 and links[here - 1] or (here == 1 and { href = 'index.html', title = titles[language].index and titles[language].index.title or words.notes }) or nil
  meta.next = links[here + 1]
  local switch = {}
  for _, code in ipairs { 'en', 'fr' } do
    if titles[code] and (titles[code][name] or titles[code].index) then
      switch[#switch + 1] = { code = code, name = ({ en = 'English', fr = 'Français' })[code], current = code == language or nil,
        href = ('../%s/%s.html'):format(code, titles[code][name] and name or 'index') }
    end
  end
  if #switch > 1 then meta.languages = switch end
  if name == 'index' and not hasCards then document.blocks:insert(chapterCards()) end
  return document
end

if env 'MODE' == 'list' then
  -- The scenes of the pairs, and the page's line; a tab cannot stand in a title.
  return { { Pandoc = function(document)
    local scenes, shown = {}, nil
    document:walk { Div = function(element)
      local scene = contains(element.classes, 'pair') and element.attributes.scene
      if scene then scenes[#scenes + 1] = scene end
      shown = shown or scene or contains(element.classes, 'scene') and element.attributes.file or nil
    end }
    local say = function(field)
      local value = document.meta[field]
      if not value then complain('its front matter has no %s:', field) return '?' end
      return (pandoc.utils.stringify(value):gsub('%s+', ' '))
    end
    local file = assert(io.open(env 'LIST', 'w'))
    file:write('page\t', language, '\t', name, '\t', say 'title', '\t', say 'summary', '\t', shown or '', '\n')
    for _, scene in ipairs(scenes) do file:write('compare\t', scene, '\n') end
    file:close()
    os.exit(failed and 1 or 0)
  end } }
end

return {
  {
    traverse = 'topdown',
    CodeBlock = function(block)
      if contains(block.classes, 'run') then return runBlock(block), false end
      for class in pairs { output = 1, volatile = 1 } do
        if contains(block.classes, class) then complain('a block .%s needs the class .run too', class) end
      end
    end,
    Div = div,
    Span = function(span) if contains(span.classes, 'value') then return valueSpan(span), false end end,
    Image = function() complain('a picture is shown with the directive .picture, not with ![]()') end,
    Link = link,
    -- A formula that is too wide for a telephone scrolls in a box of its own: browsers break none.
    Math = function(element)
      local class = element.mathtype == 'DisplayMath' and 'formula' or #element.text > 24 and 'long-formula'
      if not class then return nil end
      return { pandoc.RawInline('html', '<span class="' .. class .. '">'), element, pandoc.RawInline('html', '</span>') }
    end,
  },
  { Pandoc = finish },
}
