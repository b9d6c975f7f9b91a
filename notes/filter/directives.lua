-- directives.lua - the directives of a chapter, and which attributes each has.

local complain = require('filter.mistakes').complain

-- The attributes and classes that each directive has; those with ! must be there.
local directives = {
  pair = 'scene! alt!',
  picture = 'file! alt!',
  slider = 'a! b! a-label! b-label! alt! volatile',
  code = 'file! function from to',
  exercise = '',
  answer = '',
  plot = 'csv! x! y! xlog ylog x-label y-label y-labels alt! volatile',
  table = 'csv! volatile',
  scene = 'file!',
  chapters = '',
  note = '',
  value = 'json! get! digits scale as volatile',
  run = 'exit',
}
local function checkAttributes(directive, attributes)
  local good = true
  local known = {}
  for word in directives[directive]:gmatch '%S+' do
    local key = word:gsub('!', '')
    known[key] = true
    if word:find '!' and (attributes[key] or ''):match '^%s*$' then
      complain('the directive .%s needs %s="..."', directive, key)
      good = false
    end
  end
  for key in pairs(attributes) do
    if not known[key] then
      complain('the directive .%s has no attribute %q', directive, key)
      good = false
    end
  end
  return good
end

return { checkAttributes = checkAttributes }
