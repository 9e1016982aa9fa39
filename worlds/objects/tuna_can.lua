-- A small tin of tuna, 6.7 cm across and 4 cm high: pale blue.
local slanting = require "worlds.lib.slanting"

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.11, friction = 0.6, colour = { 0.45, 0.72, 0.90 },
  shapes = {
    cylinder { 0.0335, 0.040 },
    cylinder { 0.0338, 0.012, colour = { 0.95, 0.95, 0.97 }, collides = false },
    cylinder { 0.0305, 0.001, at = { 0, 0, 0.0201 }, colour = "silver", collides = false },
  },
  grasps = slanting.round(0.0335, 0.040, 30),
}
