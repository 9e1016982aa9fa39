-- Take the cube beside two chests that stand in one place.
return task {
  world = "tabletop",
  objects = {
    b = { "cube" },
    chest = { "chest", at = { 0.5, 0, 0.75 } },
    second = { "chest", at = { 0.5, between(0.1, 0.15), 0.75 } },
  },
  init = { is.on("b", "table") },
  goal = is.holding("b"),
  instructions = { "take the cube" },
}
