-- The lid that lies beside the saucepan covers it again.
return task {
  objects = { saucepan = { "saucepan" }, lid = { "saucepan_lid" } },
  init = { is.on("saucepan", "table"), is.on("lid", "table"), is_not.crowds("saucepan", "lid") },
  goal = { is.on("lid", "saucepan"), is.on("saucepan", "table") },
  instructions = { "put the lid back on the pan" },
}
