-- A small washing machine on a plinth; its round door opens towards -x. Its frame is below it, 0.75 m above the floor.
local doors, places = require "worlds.lib.doors", require "worlds.lib.places"
local white, glass, steel = { 0.93, 0.94, 0.95 }, { 0.20, 0.26, 0.32 }, { 0.70, 0.72, 0.75 }
local depth, width, height, radius = 0.26, 0.36, 0.40, 0.13 -- m; radius: of the door
local middle = 0.17 -- m, up to its middle

return object {
  type = "furniture", traits = {}, fixed = true, colour = white,
  place = places.round_the_table { gap = 0.14, turn = deg(45), lean = -0.16, wide = 0.36 },
  shapes = {
    box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = { 0.55, 0.56, 0.58 } }, -- what it stands on
    box { depth, width, height, at = { 0, 0, height / 2 } },
    cylinder { radius - 0.02, 0.002, at = { -depth / 2 - 0.0005, 0, middle }, rpy = { 0, math.pi / 2, 0 }, colour = { 0.15, 0.15, 0.16 }, collides = false },
    box { 0.002, 0.12, 0.035, at = { -depth / 2 - 0.0005, 0.09, height - 0.035 }, colour = { 0.85, 0.87, 0.90 }, collides = false }, -- drawer
    cylinder { 0.018, 0.010, at = { -depth / 2 - 0.005, -0.08, height - 0.035 }, rpy = { 0, math.pi / 2, 0 }, colour = steel },
  },
  parts = {
    door = doors.door {
      at = { -depth / 2 - 0.002, -radius, middle - radius }, width = 2 * radius, height = 2 * radius, round = true, thick = 0.022,
      colour = steel, mass = 0.9, open = 60, handle = { z = radius, length = 0.09 },
      shapes = { cylinder { radius - 0.03, 0.001, at = { -0.0225, radius, radius }, rpy = { 0, math.pi / 2, 0 }, colour = glass, collides = false } },
    },
  },
}
