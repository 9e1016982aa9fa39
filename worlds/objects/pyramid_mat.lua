-- A mat on which six cubes of 4 cm make a pyramid: three in a row along y, two upon them, one on top. Its frame is on the table.
local pitch, cube, thick = 0.046, 0.040, 0.002 -- m

local regions = {}
for layer = 0, 2 do
  for i = 1, 3 - layer do
    regions[({ [0] = "base", "middle", "top" })[layer] .. i] = { -- a cube's middle is within 11 mm of its place
      at = { 0, (i - (4 - layer) / 2) * pitch, thick + (layer + 0.5) * cube }, size = { 0.022, 0.022, cube + 0.004 },
      traits = { "container", "spot", layer > 0 and "raised" or nil }, numbers = { folds = 4 },
    }
  end
end

return object {
  type = "board", traits = { "surface" }, fixed = true, colour = { 0.30, 0.34, 0.38 }, regions = regions,
  shapes = {
    box { 0.09, 3 * pitch + 0.04, thick, at = { 0, 0, thick / 2 } },
    box { 0.044, 3 * pitch, 0.0004, at = { 0, 0, thick }, colour = { 0.60, 0.64, 0.68 }, collides = false },
  },
}
