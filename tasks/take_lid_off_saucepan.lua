-- Take the lid off the saucepan by its knob and hold it above the pan.
return task {
  objects = { saucepan = { "saucepan" }, lid = { "saucepan_lid" } },
  init = { is.on("saucepan", "table"), is.on("lid", "saucepan") },
  goal = { is.holding("lid"), is.inside("lid", "saucepan.overhead_space"), is.on("saucepan", "table") },
  instructions = {
    "open the pot by its knob and keep the lid in the air",
    "hold the lid of the saucepan up above it, by its knob",
    "grasp the knob of the lid and raise the lid off the pot",
    "let the steam out: lid up and away from the pan",
  },
}
