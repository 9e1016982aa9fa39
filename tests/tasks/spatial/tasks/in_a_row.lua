-- Red left of blue, blue left of green: each makes room for the next.
return task {
  world = "tabletop",
  objects = {
    red_cube = { "cube", colour = "red" }, blue_cube = { "cube", colour = "blue" }, green_cube = { "cube", colour = "green" },
  },
  init = { is.on("red_cube", "table"), is.on("blue_cube", "table"), is.on("green_cube", "table") },
  goal = { is.left_of("red_cube", "blue_cube"), is.left_of("blue_cube", "green_cube") },
  instructions = { "put the red cube to the left of the blue cube, and the blue cube to the left of the green cube" },
}
