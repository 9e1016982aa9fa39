-- The tin comes to stand beside the red cube, wherever that is.
return task {
  world = "tabletop",
  objects = { cube = { "cube", colour = "red" }, tin = { "tin" } },
  init = { is.on("cube", "table"), is.on("tin", "table"), is_not.beside("tin", "cube") },
  goal = { is.beside("tin", "cube"), is.on("tin", "table"), is.hand_empty() },
  instructions = { "put the tin beside the cube" },
}
