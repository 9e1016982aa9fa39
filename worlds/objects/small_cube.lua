-- A small wooden cube, as it goes into a shape sorter: 3.2 cm edges.
return object {
  type = "cube", traits = { "movable", "graspable" },
  shape = box { 0.032, 0.032, 0.032 }, mass = 0.03, colour = "red",
}
