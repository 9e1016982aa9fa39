-- Take the toilet roll off the rod of its stand.
return task {
  objects = {
    stand = { "toilet_roll_stand", at = on_table { between(0.12, 0.19), between(-0.18, 0.18) },
      yaw = between(-0.62 * math.pi, 0.62 * math.pi) }, -- the rod does not point at the robot
    roll = { "toilet_roll" },
  },
  init = { is.hanging("roll", "stand.rod") },
  goal = { is_not.hanging("roll", "stand.rod"),
    any_of { is.lifted("roll"), all_of { is.on("roll", "table"), is.hand_empty() } } },
  instructions = {
    "pull the roll of paper from its rod",
    "slip the paper roll off the end of its holder",
    "take the toilet roll off the rod that it hangs on",
    "the stand must be free of paper: draw the roll off it",
  },
}
