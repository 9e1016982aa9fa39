-- A squeezed mustard bottle, 8.5 × 5.8 cm and 17.5 cm high with its cap: yellow.
local slanting = require "worlds.lib.slanting"
local size = { 0.085, 0.058, 0.130 }

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.30, friction = 0.6, colour = { 0.96, 0.78, 0.05 },
  shapes = {
    box { size[1], size[2], size[3] },
    box { 0.060, size[2] + 0.001, 0.055, at = { 0, 0, -0.012 }, colour = { 0.85, 0.15, 0.10 }, collides = false },
    cone { 0.026, 0.032, at = { 0, 0, size[3] / 2 + 0.016 } },
    cylinder { 0.007, 0.018, at = { 0, 0, size[3] / 2 + 0.034 }, colour = { 0.85, 0.15, 0.10 } },
  },
  grasps = slanting.box(size, 50),
}
