-- Take the cube beside a chest that is turned by ninety radians.
return task {
  world = "tabletop",
  objects = {
    b = { "cube" },
    chest = { "chest", at = { 0.5, 0, 0.75 }, yaw = 90 },
  },
  init = { is.on("b", "table") },
  goal = is.holding("b"),
  instructions = { "take the cube" },
}
