-- mistakes.lua - what is wrong with a chapter. Nothing stops at the first mistake: each goes to the file of errors, and
-- make-notes.sh ends the build.

local env = require('filter.page').env

local failed = false
local function complain(text, ...)
  failed = true
  local file = assert(io.open(env 'ERRORS', 'a'))
  file:write(env 'FILE', ': ', select('#', ...) > 0 and text:format(...) or text, '\n')
  file:close()
end

return { complain = complain, any = function() return failed end }
