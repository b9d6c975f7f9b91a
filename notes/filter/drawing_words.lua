-- drawing_words.lua - what `eclairage why --svg` writes into its drawings, in French.
--
-- A drawing keeps its places, so French words must not be much longer than the English ones that they replace.
-- Each pattern is for the whole of one text; a drawing with other words stops the build, which names them.

local french = {
  { 'Pixel %((%d+), (%d+)%) of (.+)', 'Pixel (%1, %2) de %3' },
  { 'The plane through the ray of the camera, seen (.+)', 'Le plan du rayon de la caméra, vu %1' },
  { 'The plane through the ray of the camera and light (%d+), seen (.+)', 'Le plan du rayon de la caméra et de la lampe %1, vu %2' },
  { 'camera', 'caméra' },
  { 'light (%d+), point', 'lampe %1' },
  { 'light (%d+), point, at distance ([%d.e+]+)', 'lampe %1, à la distance %2' },
  { 'sphere, line (%d+)', 'sphère, ligne %1' },
  { 'plane, line (%d+)', 'plan, ligne %1' },
  { 'box, line (%d+)', 'boîte, ligne %1' },
  { 'blocked here by line (%d+)', 'arrêté ici\u{A0}: ligne %1' },
  { 'ray of the camera', 'rayon de caméra' },
  { 'way to a light, free', 'vers la lampe, libre' },
  { 'way to a light, blocked at the cross', 'vers la lampe, arrêté à la croix' },
  { 'way to a light that adds nothing', 'vers une lampe qui n’ajoute rien' },
  { 'N, the normal', 'N, la normale' },
  { 'V, to the eye', 'V, vers l’œil' },
  { 'L, to the light', 'L, vers la lampe' },
  { 'R, L mirrored at N', 'R, L réfléchi' },
  { 'H, halfway between L and V', 'H, entre L et V' },
  { 'Objects as the plane cuts them; a dotted circle: a sphere beside the plane.', 'Objets coupés par le plan\u{202F}; cercle en pointillé\u{A0}: une sphère hors du plan.' },
  { 'What leaves the plane is drawn as its projection, so shorter.', 'Ce qui sort du plan est projeté, donc plus court.' },
  { 'Not all objects, lights and rays are drawn.', 'Tout n’est pas dessiné.' },
  { '([NVLRHP])', '%1' },
}
local views = {
  ['from below'] = 'de dessous', ['from the side and below'] = 'de côté et de dessous', ['from the side'] = 'de côté',
  ['from the side and above'] = 'de côté et de dessus', ['from above'] = 'de dessus',
}
local allowance = 2 -- characters by which French may be longer

local function translate(text)
  for _, entry in ipairs(french) do
    local found = { text:match('^' .. entry[1] .. '$') }
    if #found > 0 then
      return (entry[2]:gsub('%%(%d)', function(i) return views[found[tonumber(i)]] or found[tonumber(i)] end))
    end
  end
end

-- The drawing in a language. unknown(words) is called for each text that has no French; the drawing's title and
-- description, which a picture in a page does not show, are left out.
return function(svg, language, unknown)
  if language ~= 'fr' then return svg end
  svg = svg:gsub('%s*<title.-</title>', ''):gsub('%s*<desc.-</desc>', ''):gsub(' aria%-labelledby="[^"]*"', '')
  return (svg:gsub('(<text[^>]*>)(.-)(</text>)', function(open, words, close)
    local said = translate(words)
    if not said or utf8.len(said) > utf8.len(words) + allowance then
      unknown(words)
      said = words
    end
    return open .. said .. close
  end))
end
