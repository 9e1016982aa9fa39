-- Pick up a block between four others that leave no room for the fingers: one has to go first.
return task {
  world = "tabletop",
  objects = {
    item = { "plain_cube", at = { 0.15, 0, 0.77 } },
    north = { "plain_cube", colour = "blue", at = { 0.195, 0, 0.77 } },
    south = { "plain_cube", colour = "green", at = { 0.105, 0, 0.77 } },
    east = { "plain_cube", colour = "yellow", at = { 0.15, -0.045, 0.77 } },
    west = { "plain_cube", colour = "cyan", at = { 0.15, 0.045, 0.77 } },
  },
  init = { is.on("item", "table") },
  goal = is.holding("item"),
  instructions = { "hold the block in the middle" },
}
