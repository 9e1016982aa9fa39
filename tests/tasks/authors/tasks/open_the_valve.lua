-- A valve of several turns: the wrist does not go round so far, the hand grips again.
return task {
  world = "tabletop",
  objects = { valve = { "valve", at = { 0.20, between(-0.1, 0.1), 0.75 }, yaw = between(-math.pi, math.pi) } },
  goal = { is.turned("valve.wheel"), is.hand_empty() },
  instructions = { "open the valve" },
}
