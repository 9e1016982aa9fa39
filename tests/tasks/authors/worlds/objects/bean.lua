-- A fat bean that lies on its side.
return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.02, rolling = 0.004, colour = { 0.55, 0.18, 0.12 },
  shape = capsule { 0.011, 0.016, rpy = { 0, math.pi / 2, 0 } },
}
