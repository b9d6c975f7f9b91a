-- tables.lua - the directive .table: a CSV file as a table.

local language = require('filter.page').language
local escape = require('filter.text').escape
local record = require('filter.numbers').record
local csvStep = require('filter.csv').csvStep
local figure = require('filter.pictures').figure

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
      if i == 1 then shown = shown:gsub('_', '_<wbr>') end
      if i > 1 and isNumber[column] and language == 'fr' then shown = shown:gsub('%.', ',') end
      cells[column] = i == 1 and ('<th scope="col"%s>%s</th>'):format(class, shown) or ('<td%s>%s</td>'):format(class, shown)
    end
    out[i] = '<tr>' .. table.concat(cells) .. '</tr>'
    if i > 1 and div.attributes.volatile ~= 'true' then record('table', file, tostring(i - 1), table.concat(row, ' ')) end
  end
  return figure('table', '<div class="scroll" tabindex="0"><table' .. (#rows[1] > 6 and ' class="many"' or '') .. '><thead>' .. out[1] .. '</thead><tbody>' .. table.concat(out, '', 2) .. '</tbody></table></div>', div)
end

return { tableDiv = tableDiv }
