-- Pick the block up from the table and put it down on the mat.
return task {
  world = "tabletop",
  objects = { item = { "cube" }, other = { "cube", count = 3 }, mat = { "mat", at = { 0.2, -0.2, 0.77 } } },
  init = { is.on("item", "table"), is.on("other*", "table") },
  goal = { is.on("item", "mat"), is.hand_empty() },
  instructions = { "put the block on the mat" },
}
