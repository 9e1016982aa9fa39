-- A toy basketball of 6.5 cm, small enough for the hand.
return object {
  type = "ball", traits = { "movable", "graspable" }, mass = 0.06, friction = 0.8, rolling = 0.002, restitution = 0.4,
  colour = { 0.88, 0.42, 0.10 },
  shapes = {
    sphere { 0.0325 },
    cylinder { 0.0329, 0.0016, colour = "black", collides = false }, -- seams
    cylinder { 0.0329, 0.0016, rpy = { deg(90), 0, 0 }, colour = "black", collides = false },
    cylinder { 0.0329, 0.0016, rpy = { 0, deg(90), 0 }, colour = "black", collides = false },
  },
}
