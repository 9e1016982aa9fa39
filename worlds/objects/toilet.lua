-- A child's toilet; its tank is at +x, and there its seat is hinged. Its frame is below it.
local lids = require "worlds.lib.lids"
local white, seat = { 0.93, 0.94, 0.95 }, { 0.96, 0.96, 0.94 }
local length, width, height, ring = 0.24, 0.25, 0.15, 0.045 -- m; ring: how wide the seat is around its hole

return object {
  type = "toilet", traits = {}, fixed = true, colour = white, friction = 0.5,
  shapes = {
    box { 0.20, 0.16, height - 0.04, at = { 0.02, 0, (height - 0.04) / 2 } }, -- foot
    box { 0.23, 0.22, 0.04, at = { 0.01, 0, height - 0.02 } }, -- rim of the bowl
    box { 0.15, 0.13, 0.001, at = { -0.01, 0, height + 0.0005 }, colour = { 0.55, 0.72, 0.80 }, collides = false },
    box { 0.08, 0.24, 0.30, at = { 0.185, 0, 0.15 } }, -- tank
    box { 0.09, 0.25, 0.016, at = { 0.185, 0, 0.308 } },
    cylinder { 0.018, 0.006, at = { 0.185, 0, 0.318 }, colour = { 0.75, 0.76, 0.78 } },
  },
  parts = {
    seat = lids.lid {
      at = { 0.125, 0, height + 0.002 }, front = length, mass = 0.35, open = 81, most = 100, colour = seat,
      shapes = {
        box { ring, width, 0.016, at = { ring / 2 - length, 0, 0.008 } },
        box { ring, width, 0.016, at = { -ring / 2, 0, 0.008 } },
        box { length - 2 * ring, ring, 0.016, at = { -length / 2, (width - ring) / 2, 0.008 } },
        box { length - 2 * ring, ring, 0.016, at = { -length / 2, (ring - width) / 2, 0.008 } },
      },
      grip = { z = 0.008, colour = { 0.70, 0.72, 0.74 } },
    },
  },
}
