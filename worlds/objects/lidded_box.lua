-- A painted box whose lid swings up towards +x. Its frame is below it; it stands on the table as furniture does.
local lids = require "worlds.lib.lids"
local wood, inner = { 0.30, 0.42, 0.47 }, { 0.80, 0.70, 0.52 } -- painted, so that it stands out from the table
local length, width, height, wall = 0.25, 0.32, 0.077, 0.010 -- m

return object {
  type = "box", traits = { "container", "reach_in" }, fixed = true, colour = wood, friction = 0.6,
  shapes = {
    box { length, width, wall, at = { 0, 0, wall / 2 }, colour = inner },
    box { wall, width, height, at = { length / 2 - wall / 2, 0, height / 2 } },
    box { wall, width, height, at = { wall / 2 - length / 2, 0, height / 2 } },
    box { length - 2 * wall, wall, height, at = { 0, width / 2 - wall / 2, height / 2 } },
    box { length - 2 * wall, wall, height, at = { 0, wall / 2 - width / 2, height / 2 } },
  },
  parts = {
    lid = lids.lid {
      at = { length / 2, 0, height + 0.001 }, front = length, mass = 0.4, open = 90, colour = wood,
      shapes = {
        box { length, width, 0.012, at = { -length / 2, 0, 0.009 } },
        box { length, width, 0.003, at = { -length / 2, 0, 0.0015 }, collides = false }, -- rests on the rim
      },
      grip = { z = 0.009, colour = { 0.86, 0.72, 0.42 } },
    },
  },
  numbers = { hand_front = -0.03, hand_back = 0.01, hand_aside = 0.038, hand_side = 0.08, hand_turn = 0.1 },
  regions = { inside = { at = { 0, 0, (height + wall) / 2 }, size = { length - 2 * wall, width - 2 * wall, height - wall } },
    outline = { at = { 0, 0, 0.02 }, size = { length + 0.10, width + 0.10, 0.04 }, traits = { "marked" } } },
}
