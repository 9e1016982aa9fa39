-- A wooden chopping board with a strip of darker wood at either end.
local strip = { 0.50, 0.31, 0.15 }
return object {
  type = "chopping_board", traits = { "movable", "surface", "support" }, mass = 1, friction = 0.6, colour = { 0.87, 0.72, 0.48 },
  shapes = {
    box { 0.30, 0.19, 0.018 },
    box { 0.018, 0.1902, 0.0182, at = { 0.125, 0, 0 }, colour = strip, collides = false },
    box { 0.018, 0.1902, 0.0182, at = { -0.125, 0, 0 }, colour = strip, collides = false },
  },
}
