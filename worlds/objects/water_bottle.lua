-- A bottle of water, 6 cm across and 17 cm high; its frame is in its middle.
local slanting = require "worlds.lib.slanting"

return object {
  type = "bottle", traits = { "movable", "graspable" }, mass = 0.25, friction = 0.6, colour = { 0.55, 0.75, 0.88 },
  shapes = {
    lathe { { 0.028, -0.085 }, { 0.030, -0.080 }, { 0.030, 0.035 }, { 0.022, 0.052 }, { 0.012, 0.064 } },
    cylinder { 0.014, 0.022, at = { 0, 0, 0.074 }, colour = { 0.10, 0.25, 0.60 } },
    lathe { { 0.0303, -0.045 }, { 0.0303, 0.015 }, wall = 0.002, colour = { 0.92, 0.94, 0.96 }, collides = false }, -- label
  },
  grasps = slanting.round(0.030, 0.085, 40, 24),
}
