-- A patch of the table is rubbed clean.
return task {
  world = "tabletop",
  objects = { patch = { "target_area", at = { 0.20, between(-0.1, 0.1), 0.75 } } },
  goal = { is.rubbed("patch"), is.hand_empty() },
  instructions = { "rub the patch clean" },
}
