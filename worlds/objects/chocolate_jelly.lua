-- A packet of chocolate jelly powder, 8.9 × 3.5 × 11 cm: brown.
local slanting = require "worlds.lib.slanting"
local size = { 0.089, 0.035, 0.110 }

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.19, friction = 0.6, colour = { 0.30, 0.17, 0.09 },
  shapes = {
    box { size[1], size[2], size[3] },
    box { 0.070, size[2] + 0.001, 0.030, at = { 0, 0, 0.022 }, colour = { 0.95, 0.93, 0.88 }, collides = false },
    cylinder { 0.017, size[2] + 0.001, at = { 0, 0, -0.025 }, rpy = { deg(90), 0, 0 }, colour = { 0.50, 0.30, 0.16 }, collides = false },
  },
  grasps = slanting.box(size, 40),
}
