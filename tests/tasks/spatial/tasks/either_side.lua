-- Red left or right of blue, blue near the tin: a circle of a goal, and a choice.
return task {
  world = "tabletop",
  objects = { red_cube = { "cube", colour = "red" }, blue_cube = { "cube", colour = "blue" }, tin = { "tin" } },
  init = { is.on("red_cube", "table"), is.on("blue_cube", "table"), is.on("tin", "table") },
  goal = {
    any_of { is.left_of("red_cube", "blue_cube"), is.right_of("red_cube", "blue_cube") },
    is.near("blue_cube", "red_cube"), is.beyond("tin", "red_cube"),
  },
  instructions = { "put the red cube beside the blue cube and the tin beyond the red cube" },
}
