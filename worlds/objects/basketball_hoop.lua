-- A toy basketball stand: ring, net and backboard over a box that catches the ball; its frame is below the ring.
local wood, white = { 0.70, 0.58, 0.42 }, { 0.94, 0.94, 0.95 }
local side = { 0.116, 0.006, 0.105 } -- too high for a ball to come in below the net

return object {
  type = "furniture", traits = { "movable", "container", "hollow" }, mass = 1.6, friction = 0.7,
  shapes = {
    box { 0.19, 0.13, 0.008, at = { 0.03, 0, 0.004 }, colour = wood },
    box { side[1], side[2], side[3], at = { 0, 0.059, 0.0605 }, colour = wood },
    box { side[1], side[2], side[3], at = { 0, -0.059, 0.0605 }, colour = wood },
    box { side[2], 0.124, side[3], at = { 0.061, 0, 0.0605 }, colour = wood },
    box { side[2], 0.124, side[3], at = { -0.061, 0, 0.0605 }, colour = wood },
    box { 0.020, 0.024, 0.30, at = { 0.092, 0, 0.158 }, colour = { 0.25, 0.27, 0.32 } }, -- post
    box { 0.008, 0.18, 0.13, at = { 0.078, 0, 0.295 }, colour = white }, -- backboard
    box { 0.002, 0.07, 0.05, at = { 0.0735, 0, 0.280 }, colour = "red", collides = false },
    box { 0.0015, 0.06, 0.04, at = { 0.0733, 0, 0.280 }, colour = white, collides = false },
    box { 0.020, 0.03, 0.008, at = { 0.064, 0, 0.241 }, colour = "orange" },
    lathe { { 0.058, 0.237 }, { 0.058, 0.245 }, wall = 0.007, colour = "orange" }, -- ring
    lathe { { 0.044, 0.150 }, { 0.054, 0.236 }, wall = 0.002, texture = checker { white, { 0.55, 0.57, 0.60 }, size = 0.02 } },
  },
  regions = { inside = { at = { 0, 0, 0.1265 }, size = { 0.10, 0.10, 0.237 } } },
}
