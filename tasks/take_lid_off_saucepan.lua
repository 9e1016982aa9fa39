-- Take the lid off the saucepan by its knob and hold it above the pan.
return task {
  world = "tabletop",
  objects = {
    saucepan = { "saucepan" },
    lid = { "saucepan_lid" },
  },
  init = { is.on("saucepan", "table"), is.on("lid", "saucepan") },
  goal = { is.holding("lid"), is.inside("lid", "saucepan.overhead_space"), is.on("saucepan", "table") },
  instructions = {
    "take the lid off the saucepan",
    "lift the lid from the pan by its knob",
    "uncover the saucepan and hold the lid above it",
    "grasp the knob of the lid and raise the lid off the pot",
  },
}
