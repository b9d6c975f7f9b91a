-- csv.lua - the columns of a CSV file that a command made.

local work = require('filter.page').work
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local step = require('filter.steps').step
local readFile, writeFile, lines = text.readFile, text.writeFile, text.lines

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

return { csvStep = csvStep }
