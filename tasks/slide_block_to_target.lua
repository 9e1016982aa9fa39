-- Slide the block, which is too wide to be taken, into the marked area of the table.
return task {
  world = "tabletop",
  objects = {
    block = { "wide_block" },
    target = { "target_area", at = { between(0.11, 0.28), between(-0.25, 0.25), 0.75 }, yaw = between(-math.pi, math.pi) },
  },
  init = { is.on("block", "table"), is.outside("block", "target") },
  goal = { is.inside("block", "target"), is.on("block", "table"), is.hand_empty() },
  instructions = {
    "slide the block to the target",
    "push the block onto the green square",
    "move the red block into the marked area without lifting it",
    "shove the block along the table until it lies on the green patch",
  },
}
