-- Pull the umbrella out of the umbrella stand and hold it clear.
return task {
  world = "tabletop",
  objects = {
    stand = { "umbrella_stand", at = { between(0.06, 0.28), between(-0.28, 0.28), 0.75 }, yaw = between(-math.pi, math.pi) },
    umbrella = { "umbrella" },
  },
  init = { is.in_slot("umbrella", "stand.tube") },
  goal = { is_not.in_slot("umbrella", "stand.tube"), is.lifted("umbrella") },
  instructions = {
    "take the umbrella out of the umbrella stand",
    "pull the umbrella from its stand",
    "lift the umbrella out of the holder",
    "remove the umbrella from the stand and hold it",
  },
}
