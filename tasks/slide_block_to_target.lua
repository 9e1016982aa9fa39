-- Slide the block, which is too wide to be taken, into the marked area of the table.
return task {
  objects = {
    block = { "wide_block" },
    target = { "target_area", at = on_table { between(0.11, 0.28), between(-0.25, 0.25) }, yaw = between(-math.pi, math.pi) },
  },
  init = { is.on("block", "table"), is.outside("block", "target") },
  goal = { is.inside("block", "target"), is.on("block", "table") },
  instructions = {
    "shove the block along the table until it lies on the green patch",
    "move the red block into the marked area without lifting it",
    "the wide red block cannot be gripped: push it to the green square",
    "nudge the block over the table and onto the green square",
  },
}
