-- A tin of tomato soup, 6.6 cm across and 10.1 cm high: red and white.
local slanting = require "worlds.lib.slanting"

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.35, friction = 0.6, colour = { 0.93, 0.92, 0.90 },
  shapes = {
    cylinder { 0.033, 0.101 },
    cylinder { 0.0334, 0.048, at = { 0, 0, 0.022 }, colour = { 0.80, 0.08, 0.08 }, collides = false },
    cylinder { 0.0336, 0.004, at = { 0, 0, -0.0485 }, colour = "silver", collides = false },
    cylinder { 0.0300, 0.001, at = { 0, 0, 0.0506 }, colour = "silver", collides = false },
  },
  grasps = slanting.round(0.033, 0.101, 50),
}
