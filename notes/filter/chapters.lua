-- chapters.lua - the chapters beside each other: their list, the links between them, and where a page stands.

local page = require 'filter.page'
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local pictureTag = require('filter.pictures').pictureTag
local env, language, name, words = page.env, page.language, page.name, page.words
local readFile, escape, html, lines, split = text.readFile, text.escape, text.html, text.lines, text.split

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

-- The list of chapters as cards.
local hasCards = false
local function chapterCards()
  hasCards = true
  local cards = {}
  for i, page in ipairs(pages) do
    local picture = page.thumbnail ~= '' and readFile(page.thumbnail) and pictureTag(page.thumbnail, '') or ''
    cards[i] = ('<li><a href="%s.html"><span class="thumb">%s</span><span class="card-text"><span class="card-number">%s %s</span><b>%s</b><span class="soft">%s</span></span></a></li>')
      :format(escape(page.name), picture, words.chapter, numberOf(page), escape(page.title), escape(page.summary))
  end
  return html('<ol class="cards">' .. table.concat(cards) .. '</ol>')
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

-- Tells the template where the page stands.
local function addPlace(document)
  local meta = document.meta
  for word, text in pairs(words) do meta['word-' .. word:lower()] = text end
  meta.lang = language
  local number = tonumber(name:match '^%d+')
  meta.number = number and tostring(number) or nil
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
end

return { chapterCards = chapterCards, link = link, addPlace = addPlace }
