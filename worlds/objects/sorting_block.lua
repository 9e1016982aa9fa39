-- A small wooden block for sorting: a cube of 2.5 cm edges.
return object {
  type = "cube", traits = { "movable", "graspable" },
  shape = box { 0.025, 0.025, 0.025 }, mass = 0.012, colour = "red",
}
