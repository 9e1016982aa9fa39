-- Put the red cube between the blue and the green one, near the blue one, to the left of the green one.
return task {
  world = "tabletop",
  objects = {
    red_cube = { "cube", colour = "red" }, blue_cube = { "cube", colour = "blue" }, green_cube = { "cube", colour = "green" },
  },
  init = { is.on("red_cube", "table"), is.on("blue_cube", "table"), is.on("green_cube", "table") },
  goal = {
    is.between("red_cube", "blue_cube", "green_cube"), is.near("red_cube", "blue_cube"), is.left_of("red_cube", "green_cube"),
  },
  instructions = { "put the red cube between the blue cube and the green cube, to the left of the green cube and near the blue cube" },
}
