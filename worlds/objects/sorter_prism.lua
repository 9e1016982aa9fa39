-- The triangular prism of the shape sorter, with blunt edges.
local holds, corner, face = {}, 0.0263, 0.0265 * math.cos(math.pi / 3 - 0.115)
for k = 0, 2 do -- a blunt edge and the face behind it
  local angle, off = k * 2 * math.pi / 3, (corner - face) / 2
  holds[k + 1] = { off * math.cos(angle), off * math.sin(angle), angle + math.pi / 2, corner + face }
end
return require "worlds.lib.sorter_solids".make("prism", "green", holds)
