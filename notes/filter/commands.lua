-- commands.lua - the directive .run: commands, and what they print; and the box with one command.

local words = require('filter.page').words
local text = require 'filter.text'
local complain = require('filter.mistakes').complain
local record = require('filter.numbers').record
local shell = require 'filter.shell'
local step = require('filter.steps').step
local checkAttributes = require('filter.directives').checkAttributes
local readFile, writeFile, quote, escape, html, lines, contains, tail = text.readFile, text.writeFile, text.quote, text.escape, text.html, text.lines, text.contains, text.tail

local count = 0 -- of the blocks so far

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

-- Commands as a page shows them: a line breaks between words only, since who types "--" and then "width" gets
-- another command. Only a word that is longer than a line breaks.
local function commandCode(text)
  local shown = {}
  for i, line in ipairs(lines(text)) do
    local said = escape(line):gsub('%S+', function(word)
      return ('<span class="word%s">%s</span>'):format(word:match '^%-' and ' at' or '', word)
    end)
    shown[i] = ('<span%s>%s</span>'):format(line:match '^%s*#' and ' class="co"' or '', said)
  end
  return html('<div class="sourceCode"><pre class="sourceCode sh"><code class="sourceCode sh">' .. table.concat(shown, '\n') .. '</code></pre></div>')
end

local function runBlock(block)
  local attributes = block.attributes
  if not checkAttributes('run', attributes) then return {} end
  count = count + 1
  local expected = tonumber(attributes.exit or '0')
  local shows = contains(block.classes, 'output')
  local commands = commandsOf(block.text)
  if #commands == 0 then complain('a block .run has no command') return {} end
  local folder = step('run exit=' .. tostring(expected) .. (shows and ' output ' or ' ') .. table.concat(commands, '; '), function(folder)
    writeFile(folder .. '/output', '')
    for i, command in ipairs(commands) do
      local wanted = i == #commands and expected or 0
      local before = #readFile(folder .. '/output')
      local code = shell.run(command, '>>' .. quote(folder .. '/output') .. ' 2>&1')
      if code ~= wanted then
        complain('the command `%s` %s, not %d%s', command, shell.sayCode(code), wanted, tail(readFile(folder .. '/output'):sub(before + 1)))
        return false
      end
    end
    return true
  end)
  local made = { html '<div class="run">', html('<button type="button" class="copy js-only">' .. words.copy .. '</button>'),
    commandCode(block.text) }
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

return {
  commandBox = commandBox,
  runBlock = runBlock,
  count = function() return count end, -- how many .run came so far: what a command of .value is cached for
}
