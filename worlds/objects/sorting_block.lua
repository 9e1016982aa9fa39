-- A small wooden block for sorting: a cube of 2.5 cm edges.
return object {
  type = "cube", traits = { "movable", "graspable" },
  shape = box { 0.025, 0.025, 0.025 }, mass = 0.012, colour = "red",
  numbers = { room = 0.048 }, -- m from its neighbours where it is put down, if it can be
}
