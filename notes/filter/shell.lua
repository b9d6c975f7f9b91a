-- shell.lua - the commands of a chapter, run as a reader would.

local work = require('filter.page').work
local text = require 'filter.text'
local quote, writeFile = text.quote, text.writeFile

local timeLimit = 120 -- seconds for one command

-- Runs one line as a shell in the work folder would; returns its exit code.
local function shell(line, redirection)
  local script = os.tmpname()
  writeFile(script, line .. '\n')
  local _, kind, code = os.execute(('cd %s && timeout -k 5 %d sh %s </dev/null %s'):format(quote(work), timeLimit, quote(script), redirection))
  os.remove(script)
  return kind == 'signal' and 128 + code or code
end
local function sayCode(code)
  if code == 124 then return ('took more than %d seconds'):format(timeLimit) end
  return ('ended with exit code %d'):format(code)
end

return { run = shell, sayCode = sayCode }
