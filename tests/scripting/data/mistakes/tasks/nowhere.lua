-- Take the cube beside a chest that stands nowhere.
return task {
  world = "tabletop",
  objects = { b = { "cube" }, chest = { "chest" } },
  init = { is.on("b", "table") },
  goal = is.holding("b"),
  instructions = { "take the cube" },
}
