-- Put the red cube to the left of the blue one, where two green ones stand already.
return task {
  world = "tabletop",
  objects = {
    red_cube = { "cube", colour = "red" }, blue_cube = { "cube", colour = "blue" }, green_cube = { "cube", colour = "green", count = 2 },
  },
  init = {
    is.on("red_cube", "table"), is.on("blue_cube", "table"), is.on("green_cube*", "table"),
    is.left_of("green_cube1", "blue_cube"), is.near("green_cube1", "blue_cube"),
    is.left_of("green_cube2", "green_cube1"), is.near("green_cube2", "green_cube1"),
  },
  goal = { is.left_of("red_cube", "blue_cube"), is.near("red_cube", "blue_cube") },
  instructions = { "put the red cube to the left of the blue cube, near it" },
}
