-- steps.lua - what the first language of a chapter does, and the others repeat.
--
-- The first language keeps what came out of each directive below .steps in the chapter's work folder. Every other
-- language must hold the same directives in the same order, and shows the same results.

local page = require 'filter.page'
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local leads, work = page.leads, page.work
local readFile, writeFile, quote, lines = text.readFile, text.writeFile, text.quote, text.lines

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

-- At the end of the page: holds the directives, and the keys of its values, against those of the other language.
local function compareWithOther(valueKeys)
  table.sort(valueKeys)
  local keys = table.concat(valueKeys, '\n')
  if leads then
    os.execute('mkdir -p ' .. quote(work .. '/.steps'))
    writeFile(work .. '/.steps/values', keys)
    writeFile(work .. '/.steps/count', tostring(stepCount))
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
end

return { step = step, compareWithOther = compareWithOther }
