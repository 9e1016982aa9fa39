-- A safe with three shelves, its door open; it opens towards -x. Its frame is below it, 0.75 m above the floor.
local places = require "worlds.lib.places"
local steel, dark, brass = { 0.34, 0.36, 0.40 }, { 0.24, 0.25, 0.28 }, { 0.75, 0.62, 0.28 }
local width, depth, pitch = 0.36, 0.22, 0.22 -- m; pitch: from shelf to shelf

local function level(n)
  return {
    type = "level", traits = { "container", "shelf" }, fixed = { at = { 0, 0, 0.012 + (n - 1) * pitch } },
    mass = 1, colour = { 0.58, 0.60, 0.64 }, friction = 0.6,
    shapes = { box { depth, width, 0.010, at = { 0, 0, 0.005 } } },
    regions = { inside = { at = { 0, 0, 0.010 + 0.07 }, size = { depth, width, 0.14 } } },
  }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = steel,
  place = places.beside_the_table { gap = 0.17, turn = deg(45), wide = 0.38 },
  shapes = {
    box { depth + 0.03, width + 0.06, 0.75, at = { 0.015, 0, -0.375 }, colour = { 0.55, 0.43, 0.31 } }, -- what it stands on
    box { depth + 0.03, width + 0.06, 0.012, at = { 0.015, 0, 0.006 } },
    box { depth + 0.03, width + 0.06, 0.025, at = { 0.015, 0, 0.012 + 3 * pitch + 0.0125 } },
    box { depth + 0.03, 0.03, 3 * pitch, at = { 0.015, width / 2 + 0.015, 0.012 + 1.5 * pitch } },
    box { depth + 0.03, 0.03, 3 * pitch, at = { 0.015, -width / 2 - 0.015, 0.012 + 1.5 * pitch } },
    box { 0.03, width, 3 * pitch, at = { depth / 2 + 0.015, 0, 0.012 + 1.5 * pitch } },
  },
  parts = {
    bottom_shelf = level(1), middle_shelf = level(2), top_shelf = level(3),
    door = { -- a joint that no task moves
      type = "fixture", mass = 4, colour = steel,
      hinge = { at = { -depth / 2 - 0.002, -width / 2 - 0.028, 0.012 }, range = { 0, math.rad(175) }, initial = math.rad(165),
        damping = 0.5, friction = 2 },
      shapes = {
        box { 0.025, width + 0.05, 3 * pitch + 0.02, at = { -0.0145, width / 2 + 0.025, 1.5 * pitch } },
        box { 0.006, width - 0.04, 3 * pitch - 0.04, at = { 0.001, width / 2 + 0.025, 1.5 * pitch }, colour = dark, collides = false },
        cylinder { 0.035, 0.012, at = { -0.033, width / 2 + 0.025, 1.5 * pitch }, rpy = { 0, deg(90), 0 }, colour = brass },
        box { 0.03, 0.012, 0.10, at = { -0.045, width / 2 + 0.025, 1.5 * pitch }, colour = brass, collides = false },
      },
    },
  },
}
