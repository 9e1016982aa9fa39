-- A book that stands upright, 12 × 3.4 cm and 17 cm high: its spine is at -x.
local slanting = require "worlds.lib.slanting"
local size = { 0.120, 0.034, 0.170 }
local cover = 0.003 -- m

return object {
  type = "book", traits = { "movable", "graspable" }, mass = 0.25, friction = 0.6, colour = "blue",
  shapes = {
    box { size[1], cover, size[3], at = { 0, (size[2] - cover) / 2, 0 } },
    box { size[1], cover, size[3], at = { 0, -(size[2] - cover) / 2, 0 } },
    box { cover, size[2] - 2 * cover, size[3], at = { -(size[1] - cover) / 2, 0, 0 } },
    box { size[1] - 2 * cover, size[2] - 2 * cover, size[3] - 0.004, at = { 0, 0, 0 }, colour = { 0.95, 0.93, 0.86 } },
  },
  grasps = slanting.box(size, 50),
}
