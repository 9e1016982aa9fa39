-- A stack of banknotes with two paper bands, as large as small notes are: 12 × 6.2 cm, 3.4 cm high.
local slanting = require "worlds.lib.slanting"
local size = { 0.120, 0.062, 0.034 }
local band = { 0.93, 0.90, 0.80 }

return object {
  type = "money", traits = { "movable", "graspable" }, mass = 0.20, friction = 0.6, colour = { 0.36, 0.56, 0.38 },
  shapes = {
    box { size[1], size[2], size[3], texture = stripes { { 0.40, 0.60, 0.42 }, { 0.30, 0.48, 0.33 }, size = 0.006 } },
    box { 0.014, size[2] + 0.001, size[3] + 0.001, at = { 0.022, 0, 0 }, colour = band, collides = false },
    box { 0.014, size[2] + 0.001, size[3] + 0.001, at = { -0.022, 0, 0 }, colour = band, collides = false },
    cylinder { 0.012, 0.0012, at = { 0.045, 0, size[3] / 2 }, colour = { 0.25, 0.42, 0.28 }, collides = false },
    cylinder { 0.012, 0.0012, at = { -0.045, 0, size[3] / 2 }, colour = { 0.25, 0.42, 0.28 }, collides = false },
  },
  grasps = slanting.flat(size, 40),
}
