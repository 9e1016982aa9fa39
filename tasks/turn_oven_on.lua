-- Turn the oven on: the knob in the middle of the cooker's panel, by a quarter turn.
return task {
  objects = { cooker = { "cooker" } },
  init = { is_not.turned("cooker.oven_knob"), is.workable_by_turning("cooker.oven_knob") },
  goal = { is.turned("cooker.oven_knob") },
  instructions = {
    "turn the oven on",
    "switch on the oven with the knob in the middle",
    "the oven has to heat up: turn its knob by a quarter",
    "turn the middle knob of the cooker, the one with the red mark",
  },
}
