-- charts.lua - the directive .plot: columns of a CSV file as lines of a chart.

local language = require('filter.page').language
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local numbers = require 'filter.numbers'
local csvStep = require('filter.csv').csvStep
local figure = require('filter.pictures').figure
local escape, split, contains = text.escape, text.split, text.contains
local localize, record = numbers.localize, numbers.record

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
    local least = math.huge
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
        extend(range.x, x) extend(range.y, y)
        least = math.min(least, y)
      else series[s][#series[s] + 1] = false end
    end
    if least == math.huge then complain('%s: nothing of column %s can be drawn', a.csv, column) return {} end
  end
  -- Every point is recorded, not only the ends of a line: it may change between them.
  for i = 1, a.volatile == 'true' and 0 or #rows - 1 do
    local drawn = { ('%.4g'):format(tonumber(rows[i + 1][columns[a.x]]) or 0 / 0) }
    for s = 1, #names do drawn[s + 1] = series[s][i] and ('%.4g'):format(series[s][i][2]) or '-' end
    record('plot', a.csv, a.y .. ' ' .. i, table.concat(drawn, ' '))
  end

  -- Draw the grid, then the lines: each has its colour, its dashes and its marks.
  local xAxis, yAxis = makeAxis(range.x[1], range.x[2], xlog), makeAxis(range.y[1], range.y[2], ylog, true)
  local left, right, top, bottom = 78, 708, 14, 318
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

return { plotDiv = plotDiv }
