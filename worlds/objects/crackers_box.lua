-- A box of crackers, 13 × 5.2 × 15 cm.
local slanting = require "worlds.lib.slanting"
local size = { 0.130, 0.052, 0.150 }

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.20, friction = 0.6, colour = { 0.80, 0.12, 0.10 },
  shapes = {
    box { size[1], size[2], size[3] },
    box { 0.10, size[2] + 0.001, 0.045, at = { 0, 0, 0.035 }, colour = { 0.97, 0.90, 0.55 }, collides = false },
    cylinder { 0.026, size[2] + 0.001, at = { 0, 0, -0.035 }, rpy = { deg(90), 0, 0 }, colour = { 0.90, 0.72, 0.38 }, collides = false },
  },
  grasps = slanting.box(size, 50),
}
