-- Take the cube beside a barbecue that stands nowhere.
return task {
  world = "tabletop",
  objects = { b = { "cube" }, barbecue = { "barbecue" } },
  init = { is.on("b", "table") },
  goal = is.holding("b"),
  instructions = { "take the cube" },
}
