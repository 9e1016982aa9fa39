-- A square rod of 20 mm; its frame is at its lower end.
return object {
  type = "peg", traits = { "movable", "graspable" }, mass = 0.08, friction = 0.5, colour = "blue",
  shapes = { box { 0.02, 0.02, 0.07, at = { 0, 0, 0.035 } } },
  grasps = each(range(0, 3), function(k)
    return { at = { 0, 0, 0.046 }, rpy = { math.pi, 0, k * math.pi / 2 }, width = 0.02, approach = 0.08, force = 40 }
  end),
  regions = { seat = { size = { 0.002, 0.002, 0.002 } } },
}
