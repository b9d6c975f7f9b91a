-- comparisons.lua - the directives .pair, .slider and .picture: pictures beside each other with their difference and its
-- numbers, or one alone.

local page = require 'filter.page'
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local numbers = require 'filter.numbers'
local shell = require 'filter.shell'
local step = require('filter.steps').step
local commandBox = require('filter.commands').commandBox
local pictures = require 'filter.pictures'
local env, language, work, words = page.env, page.language, page.work, page.words
local readFile, writeFile, quote, escape, lines, split, tail = text.readFile, text.writeFile, text.quote, text.escape, text.lines, text.split, text.tail
local localize, formatNumber, formatShare, record = numbers.localize, numbers.formatNumber, numbers.formatShare, numbers.record
local keepPicture, pictureTag, figure = pictures.keepPicture, pictures.pictureTag, pictures.figure
local translateDrawing = require 'filter.drawing_words'

-- Two pictures with a slider between them, their difference, and numbers: label, value and perhaps a mark.
-- Of the picture of the difference the part below, its scale, is cut off: the page has one with words that can be
-- read, from 0 to most, in the colours of compare/colormap.c.
local function slider(first, second, firstLabel, secondLabel, difference, alt, facts, most)
  local width, height = string.unpack('>I4I4', readFile(first), 17)
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
    ('<div class="mapped%s"><div class="map" style="aspect-ratio: %d / %d">%s<span class="label">%s</span></div>'):format(most == 0 and ' same' or '', width, height,
      pictureTag(difference, words.differenceAlt:format(facts[1][2]:gsub('<.->', ''))), words.difference),
    most > 0 and ('<p class="scale">0<span class="colours"></span>%s</p>'):format((formatNumber(most, 2))) or '<p class="scale">' .. words.equal .. '</p>',
    '</div></div><dl class="facts">', table.concat(cells), '</dl>',
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
  return figure('compared', slider(folder .. '/ours.png', folder .. '/povray.png', 'Éclairage', 'POV-Ray', folder .. '/difference.png', alt, facts, result.max),
    div, commandBox(command, words.command))
end

local function sliderDiv(div)
  local a = div.attributes
  local command = ('build/eclairage diff %s %s'):format(a.a, a.b)
  local folder = step('slider ' .. a.a .. ' ' .. a.b, function(folder)
    if not keepPicture(work .. '/' .. a.a, a.a, folder .. '/a.png') or not keepPicture(work .. '/' .. a.b, a.b, folder .. '/b.png') then return false end
    local code = shell.run(('build/eclairage diff --quiet --json %s %s -o %s'):format(quote(a.a), quote(a.b), quote(folder .. '/map.png')),
      '>' .. quote(folder .. '/json') .. ' 2>' .. quote(folder .. '/error'))
    if code > 1 then
      complain('`%s` %s%s', command, shell.sayCode(code), tail(readFile(folder .. '/error')))
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
  return figure('compared', slider(folder .. '/a.png', folder .. '/b.png', a['a-label'], a['b-label'], folder .. '/difference.png', a.alt, facts, c[1]),
    div, commandBox(command, words.command))
end

local function pictureDiv(div)
  local file = div.attributes.file
  local folder = step('picture ' .. file, function(folder) return keepPicture(work .. '/' .. file, file, folder .. '/picture') end)
  if not folder then return {} end
  local path, frame = folder .. '/picture', '<div class="frame">'
  if file:match '%.svg$' then
    -- A drawing has words, in the page's language; it is not made smaller than they can be read.
    path, frame = path .. '.' .. language, '<div class="frame drawing scroll" tabindex="0">'
    writeFile(path, translateDrawing(readFile(folder .. '/picture'), language, function(said)
      complain('the drawing %s says "%s", for which notes/filter/drawing_words.lua has no %s words of about that length', file, said, language)
    end))
  end
  return figure('picture', frame .. pictureTag(path, div.attributes.alt) .. '</div>', div)
end

return { pairDiv = pairDiv, sliderDiv = sliderDiv, pictureDiv = pictureDiv }
