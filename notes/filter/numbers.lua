-- numbers.lua - numbers as people write them, and the list of those that a page shows.

local page = require 'filter.page'
local language = page.language

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

-- What the page shows goes to the list of numbers, if it is this language that runs the commands.
local recorded = {}
local function record(directive, command, path, value)
  if not page.leads then return end
  local cells = { page.name, directive, command, path, value }
  for i, cell in ipairs(cells) do cells[i] = cell:find '[,"\n]' and '"' .. cell:gsub('"', '""') .. '"' or cell end
  recorded[#recorded + 1] = table.concat(cells, ',')
end
-- All of it, as lines of CSV.
local function allRecorded() return #recorded > 0 and table.concat(recorded, '\n') .. '\n' or '' end

return { localize = localize, formatNumber = formatNumber, formatShare = formatShare, percentSign = percentSign, record = record, allRecorded = allRecorded }
