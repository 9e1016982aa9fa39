-- A small wooden cylinder, as it goes into a shape sorter: 3.6 cm across, 3.2 cm high.
return object {
  type = "cylinder", traits = { "movable", "graspable" },
  shape = cylinder { 0.018, 0.032 }, mass = 0.03, colour = "blue",
}
