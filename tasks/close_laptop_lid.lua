-- Fold the screen of the laptop down.
return task {
  objects = { laptop = { "laptop", at = on_table { between(0.04, 0.20), between(-0.18, 0.18) }, yaw = between(-math.pi, math.pi),
    joints = { lid = between(deg(100), deg(112)) } } },
  init = { is_not.closed("laptop.lid"), is.workable("laptop.lid") },
  goal = { is.closed("laptop.lid") },
  instructions = {
    "close the laptop",
    "fold the screen of the laptop down onto the keyboard",
    "work is over: shut the laptop",
    "bring the lid of the laptop down",
  },
}
