-- Unscrew the lid of the jar and put it on the table.
return task {
  world = "tabletop",
  objects = { jar = { "jar", at = { between(0.10, 0.30), between(-0.2, 0.2), 0.75 } } },
  init = { is.joined("jar.lid") },
  goal = { is.on("jar.lid", "table"), is.hand_empty() },
  instructions = { "unscrew the lid of the jar and put it on the table" },
}
