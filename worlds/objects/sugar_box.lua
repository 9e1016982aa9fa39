-- A box of sugar, 8.9 × 4.2 × 15.5 cm.
local slanting = require "worlds.lib.slanting"
local size = { 0.089, 0.042, 0.155 }

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.35, friction = 0.6, colour = { 0.96, 0.84, 0.16 },
  shapes = {
    box { size[1], size[2], size[3] },
    box { size[1] + 0.001, size[2] + 0.001, 0.035, at = { 0, 0, -0.045 }, colour = "white", collides = false },
    box { size[1] + 0.0015, size[2] + 0.0015, 0.012, at = { 0, 0, -0.020 }, colour = { 0.15, 0.25, 0.65 }, collides = false },
  },
  grasps = slanting.box(size, 60),
}
