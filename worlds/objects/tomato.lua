-- A ripe tomato of 6 cm with its green stalk.
return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.09, friction = 0.7, rolling = 0.003, colour = { 0.86, 0.12, 0.07 },
  shapes = {
    sphere { 0.030 },
    cone { 0.014, 0.005, at = { 0, 0, 0.0305 }, colour = { 0.15, 0.45, 0.12 }, collides = false },
    cylinder { 0.002, 0.010, at = { 0, 0, 0.034 }, colour = { 0.20, 0.38, 0.12 }, collides = false },
  },
}
