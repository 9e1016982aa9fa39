-- Pull the umbrella out of the umbrella stand and hold it clear.
return task {
  objects = {
    stand = { "umbrella_stand", at = on_table { between(0.06, 0.28), between(-0.28, 0.28) }, yaw = between(-math.pi, math.pi) },
    umbrella = { "umbrella" },
  },
  init = { is.in_slot("umbrella", "stand.tube") },
  goal = { is_not.in_slot("umbrella", "stand.tube"), is.lifted("umbrella") },
  instructions = {
    "draw the umbrella up out of its tube",
    "pull the umbrella up and clear of its stand",
    "it rains: get hold of the umbrella",
    "hold the umbrella in the air, out of the stand",
  },
}
