-- A wooden tray to serve on, with a rim of 2 cm; its frame is on the floor inside, 6 mm above what it stands on.
local length, width, floor, rim, wall = 0.20, 0.26, 0.006, 0.020, 0.008 -- m
local wood = { 0.62, 0.42, 0.24 }

return object {
  type = "tray", traits = { "surface", "support", "container", "reach_in" }, fixed = true, colour = wood, friction = 0.6,
  shapes = {
    box { length, width, floor, at = { 0, 0, -floor / 2 } },
    box { wall, width, rim, at = { (length - wall) / 2, 0, rim / 2 } },
    box { wall, width, rim, at = { (wall - length) / 2, 0, rim / 2 } },
    box { length - 2 * wall, wall, rim, at = { 0, (width - wall) / 2, rim / 2 } },
    box { length - 2 * wall, wall, rim, at = { 0, (wall - width) / 2, rim / 2 } },
  },
  regions = { inside = { at = { 0, 0, 0.04 }, size = { length - 2 * wall, width - 2 * wall, 0.08 } } },
  numbers = { hand_front = -0.04, hand_back = 0.04, hand_side = 0.07, hand_turn = 0.4 },
}
