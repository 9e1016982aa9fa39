-- A tin of luncheon meat, 9.8 × 5.6 × 8.3 cm: blue with a yellow stripe.
local slanting = require "worlds.lib.slanting"
local size = { 0.098, 0.056, 0.083 }

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.37, friction = 0.6, colour = { 0.12, 0.22, 0.58 },
  shapes = {
    box { size[1], size[2], size[3] },
    box { size[1] + 0.001, size[2] + 0.001, 0.020, at = { 0, 0, 0.005 }, colour = { 0.97, 0.83, 0.12 }, collides = false },
    box { size[1] - 0.006, size[2] - 0.006, 0.001, at = { 0, 0, 0.0418 }, colour = "silver", collides = false },
  },
  grasps = slanting.box(size, 60),
}
