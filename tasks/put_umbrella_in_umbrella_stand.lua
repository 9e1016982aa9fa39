-- Stand the umbrella in the umbrella stand.
return task {
  objects = {
    stand = { "umbrella_stand", at = on_table { between(0.06, 0.28), between(-0.28, 0.28) }, yaw = between(-math.pi, math.pi) },
    umbrella = { "umbrella" },
  },
  init = { is.on("umbrella", "table") },
  goal = { is.in_slot("umbrella", "stand.tube") },
  instructions = {
    "put the umbrella into its stand",
    "the umbrella may drip: stand it in the tube",
    "lower the umbrella into the umbrella stand",
    "stow the umbrella upright in the tube of its stand",
  },
}
