-- A cube of 4 cm edges.
return object {
  type = "cube", traits = { "movable", "graspable", "surface" }, mass = 0.1, colour = "white",
  shape = box { 0.04, 0.04, 0.04 }, attributes = { material = "wood" }, numbers = { weight = 0.1 },
}
