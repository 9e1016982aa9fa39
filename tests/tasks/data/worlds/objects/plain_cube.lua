-- A cube that nothing is put down on.
return object {
  type = "cube", traits = { "movable", "graspable" },
  shape = box { 0.04, 0.04, 0.04 }, mass = 0.1, colour = "red",
}
