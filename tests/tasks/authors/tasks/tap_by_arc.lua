-- A tap is turned along the arc of its joint.
return task {
  world = "tabletop",
  skills = { "turn_by_arc" },
  objects = { basin = { "basin_tap", at = { 0.20, 0, 0.75 }, yaw = between(-1, 1) } },
  goal = { is.turned("basin.left_tap"), is.hand_empty() },
  instructions = { "turn the left tap on" },
}
