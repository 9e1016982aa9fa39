-- A pea.
return object {
  type = "food", traits = { "movable" }, mass = 0.004, rolling = 0.0005, colour = { 0.35, 0.65, 0.20 }, shape = sphere { 0.006 },
}
