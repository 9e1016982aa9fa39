-- A cup without a handle, 6.6 cm across and 9 cm high; its frame is in its middle.
local slanting = require "worlds.lib.slanting"
local radius, height, wall = 0.033, 0.090, 0.004 -- m

return object {
  type = "cup", traits = { "movable", "graspable" }, colour = "white", mass = 0.16, friction = 0.6,
  shapes = {
    lathe { { radius, -height / 2 + 0.004 }, { radius, height / 2 }, wall = wall },
    cylinder { radius, 0.006, at = { 0, 0, 0.003 - height / 2 } },
  },
  grasps = slanting.round(radius, height, 30, 24),
}
