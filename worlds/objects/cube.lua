-- A wooden cube of 4 cm edges.
return object {
  type = "cube", traits = { "movable", "graspable", "support", "stackable" },
  shape = box { 0.04, 0.04, 0.04 }, mass = 0.1, colour = "red",
}
