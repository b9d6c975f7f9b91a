-- exercises.lua - the directives .exercise and .answer.

local page = require 'filter.page'
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local step = require('filter.steps').step
local words = page.words
local html, contains = text.html, text.contains

local chapterNumber = tonumber(page.name:match '^%d+')
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

return { exerciseDiv = exerciseDiv, answerDiv = answerDiv }
