-- Put the red cube to the left of the blue one.
return task {
  world = "tabletop",
  objects = { red_cube = { "cube", colour = "red" }, blue_cube = { "cube", colour = "blue" } },
  init = { is.on("red_cube", "table"), is.on("blue_cube", "table") },
  goal = is.left_of("red_cube", "blue_cube"),
  instructions = { "put the red cube to the left of the blue cube" },
}
