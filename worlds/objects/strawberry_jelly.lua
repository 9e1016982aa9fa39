-- A packet of strawberry jelly powder, 8.5 × 3 × 9 cm: pink with a red fruit.
local slanting = require "worlds.lib.slanting"
local size = { 0.085, 0.030, 0.090 }

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.10, friction = 0.6, colour = { 0.96, 0.62, 0.70 },
  shapes = {
    box { size[1], size[2], size[3] },
    box { 0.066, size[2] + 0.001, 0.024, at = { 0, 0, 0.020 }, colour = "white", collides = false },
    cylinder { 0.016, size[2] + 0.001, at = { 0, 0, -0.018 }, rpy = { deg(90), 0, 0 }, colour = { 0.85, 0.08, 0.12 }, collides = false },
  },
  grasps = slanting.box(size, 30),
}
