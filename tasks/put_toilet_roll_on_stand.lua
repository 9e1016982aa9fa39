-- Put the toilet roll that lies on the table on the rod of its stand.
return task {
  objects = {
    stand = { "toilet_roll_stand", at = on_table { between(0.12, 0.19), between(-0.18, 0.18) },
      yaw = between(-0.62 * math.pi, 0.62 * math.pi) }, -- the rod does not point at the robot
    roll = { "toilet_roll", at = on_table { between(0.02, 0.36), between(-0.32, 0.32), 0.0332 },
      rpy = { 0, math.pi / 2, between(-math.pi, math.pi) } }, -- on its side
  },
  init = { is.on("roll", "table"), is_not.crowds("stand", "roll") },
  goal = { is.hanging("roll", "stand.rod") },
  instructions = {
    "slide the roll of paper onto its rod",
    "the stand has no paper: put the roll on it",
    "hang the toilet roll on the holder that stands on the table",
    "push the paper roll over the end of the rod and let it hang there",
  },
}
