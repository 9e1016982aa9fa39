-- A stand with a level rod for a toilet roll; the rod points along +x.
local steel = { 0.55, 0.57, 0.60 }
local z = 0.17 -- m: of the rod

return object {
  type = "stand", traits = {}, fixed = true, colour = steel, friction = 0.4,
  shapes = {
    cylinder { 0.07, 0.014, at = { 0.04, 0, 0.007 }, colour = { 0.30, 0.31, 0.33 } },
    cylinder { 0.010, z + 0.008, at = { 0, 0, (z + 0.008) / 2 } },
    cylinder { 0.008, 0.125, at = { 0.0625, 0, z }, rpy = { 0, math.pi / 2, 0 } },
    sphere { 0.011, at = { 0.125, 0, z } },
  },
  regions = { -- where the middle of the hole lies for as long as the rod is in it
    rod = {
      at = { 0.068, 0, z - 0.0133 }, rpy = { 0, math.pi / 2, 0 }, size = { 0.04, 0.04, 0.23 },
      traits = { "hook" }, numbers = { lift = 0.0133, deep = 0.140, play = 0.006, askew = deg(10) },
    },
  },
}
