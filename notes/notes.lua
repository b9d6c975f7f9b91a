-- notes.lua - turns the directives of a chapter into what a reader sees (a filter for pandoc 2.17 or later).
--
-- A chapter is walked once, from its first line to its last, and each directive acts when it is met: commands
-- run, pictures are taken as they are at that moment. So a page shows what a reader who types its commands in
-- order gets. The first language of a chapter does this and keeps what came out below .steps in the chapter's
-- work folder; every other language must hold the same directives and shows the same results.
-- Nothing stops at the first mistake: each goes to the file of errors, and the driver ends the build.
-- What each directive does stands in the folder filter, a file for each kind.
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

-- Modules are looked for beside this file.
package.path = (PANDOC_SCRIPT_FILE:match '^(.*)/' or '.') .. '/?.lua;' .. package.path

local page = require 'filter.page'
local text = require 'filter.text'
local mistakes = require 'filter.mistakes'
local numbers = require 'filter.numbers'
local steps = require 'filter.steps'
local checkAttributes = require('filter.directives').checkAttributes
local commands = require 'filter.commands'
local values = require 'filter.values'
local comparisons = require 'filter.comparisons'
local listings = require 'filter.listings'
local exercises = require 'filter.exercises'
local tables = require 'filter.tables'
local charts = require 'filter.charts'
local chapters = require 'filter.chapters'
local env, language, name = page.env, page.language, page.name
local writeFile, contains = text.writeFile, text.contains
local complain = mistakes.complain

local divs = {
  pair = comparisons.pairDiv, picture = comparisons.pictureDiv, slider = comparisons.sliderDiv, code = listings.codeDiv, scene = listings.sceneDiv,
  exercise = exercises.exerciseDiv, answer = exercises.answerDiv, plot = charts.plotDiv, table = tables.tableDiv,
}
local function div(element)
  local class = element.classes[1]
  if not class then return nil end
  if class == 'chapters' then return chapters.chapterCards() end
  if class == 'note' then return nil end
  if not divs[class] then complain('there is no directive .%s', class) return nil end
  if not checkAttributes(class, element.attributes) then return {} end
  return divs[class](element)
end

local function finish(document)
  steps.compareWithOther(values.keys())
  if page.leads then writeFile(env 'NUMBERS', numbers.allRecorded()) end
  chapters.addPlace(document)
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
    os.exit(mistakes.any() and 1 or 0)
  end } }
end

return {
  {
    traverse = 'topdown',
    CodeBlock = function(block)
      if contains(block.classes, 'run') then return commands.runBlock(block), false end
      for class in pairs { output = 1, volatile = 1 } do
        if contains(block.classes, class) then complain('a block .%s needs the class .run too', class) end
      end
    end,
    -- An option is one word.
    Code = function(code)
      if code.text:match '^%-' and #code.text <= 24 then code.classes:insert 'option' end
      return code
    end,
    Div = div,
    Span = function(span) if contains(span.classes, 'value') then return values.valueSpan(span), false end end,
    Image = function() complain('a picture is shown with the directive .picture, not with ![]()') end,
    Link = chapters.link,
    -- A formula that is too wide for a telephone scrolls in a box of its own: browsers break none.
    Math = function(element)
      local class = element.mathtype == 'DisplayMath' and 'formula' or #element.text > 24 and 'long-formula'
      if not class then return nil end
      return { pandoc.RawInline('html', '<span class="' .. class .. '">'), element, pandoc.RawInline('html', '</span>') }
    end,
  },
  { Pandoc = finish },
}
