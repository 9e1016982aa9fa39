-- A microwave oven on a cupboard, with a shelf inside; its door opens towards -x. Its frame is below it, 0.75 m above the floor.
local doors, places = require "worlds.lib.doors", require "worlds.lib.places"
local body, dark, inner = { 0.82, 0.83, 0.85 }, { 0.12, 0.12, 0.14 }, { 0.90, 0.90, 0.88 }
local depth, width, height, wall, panel = 0.24, 0.36, 0.22, 0.012, 0.08 -- m; panel: beside the door

return object {
  type = "furniture", traits = {}, fixed = true, colour = body,
  place = places.round_the_table { gap = 0.13, turn = deg(22), lean = -0.14, wide = 0.36 },
  shapes = {
    box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = { 0.60, 0.45, 0.30 } }, -- what it stands on
    box { depth, width, wall, at = { 0, 0, wall / 2 } },
    box { depth, width, wall, at = { 0, 0, height - wall / 2 } },
    box { wall, width, height, at = { depth / 2 - wall / 2, 0, height / 2 } },
    box { depth, wall, height, at = { 0, -width / 2 + wall / 2, height / 2 } },
    box { depth, panel, height, at = { 0, width / 2 - panel / 2, height / 2 } },
    box { 0.002, panel - 0.02, 0.03, at = { -depth / 2 - 0.001, width / 2 - panel / 2, height - 0.035 }, colour = { 0.1, 0.3, 0.2 }, collides = false },
    cylinder { 0.014, 0.004, at = { -depth / 2 - 0.002, width / 2 - panel / 2, 0.10 }, rpy = { 0, math.pi / 2, 0 }, colour = dark, collides = false },
    cylinder { 0.014, 0.004, at = { -depth / 2 - 0.002, width / 2 - panel / 2, 0.055 }, rpy = { 0, math.pi / 2, 0 }, colour = dark, collides = false },
  },
  parts = {
    shelf = {
      type = "level", traits = { "container", "shelf" }, fixed = { at = { 0, -panel / 2 + wall / 2, wall } }, mass = 1, colour = inner, friction = 0.5,
      shapes = { box { depth - 2 * wall, width - panel - wall, 0.004, at = { 0, 0, 0.002 } } },
      regions = { inside = { at = { 0, 0, height / 2 - wall }, size = { depth - 2 * wall, width - panel - wall, height - 2 * wall - 0.008 } } },
    },
    door = doors.door {
      at = { -depth / 2 - 0.001, -width / 2, 0 }, width = width - panel, height = height, colour = dark,
      handle = { z = 0.12, length = 0.12 },
      shapes = { box { 0.001, width - panel - 0.09, height - 0.07, at = { -0.0205, (width - panel) / 2 - 0.015, height / 2 },
        colour = { 0.25, 0.27, 0.30 }, collides = false } },
    },
  },
  regions = { front = { at = { -depth / 2 - 0.20, -0.08, 0.10 }, size = { 0.40, 0.70, 0.20 }, traits = { "container" } } }, -- where its door swings, and behind it
}
