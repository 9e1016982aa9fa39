-- A peg goes into its bore.
return task {
  world = "tabletop",
  objects = { block = { "bored_block", at = { 0.25, between(-0.15, 0.15), 0.75 } }, peg = { "dowel" } },
  init = { is.on("peg", "table") },
  goal = { is.in_slot("peg", "block.bore"), is.hand_empty() },
  instructions = { "put the peg into the bore" },
}
