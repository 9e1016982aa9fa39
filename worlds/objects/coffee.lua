-- A jar of coffee, 7 cm across and 12 cm high: dark brown with a red lid.
local slanting = require "worlds.lib.slanting"

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.30, friction = 0.6, colour = { 0.20, 0.11, 0.06 },
  shapes = {
    cylinder { 0.035, 0.120 },
    cylinder { 0.0353, 0.045, at = { 0, 0, -0.020 }, colour = { 0.90, 0.80, 0.55 }, collides = false },
    cylinder { 0.0353, 0.022, at = { 0, 0, 0.0496 }, colour = { 0.75, 0.10, 0.08 }, collides = false },
  },
  grasps = slanting.round(0.035, 0.120, 50),
}
