-- Things that are drawn in many ways.
return task {
  world = "studio",
  objects = {
    green = { "wedge", at = { 0, 0, 0.52 } },
    red = { "wedge", at = { 0.1, 0, 0.52 }, colour = "red" },
    tiled = { "tiled", at = { 0.2, 0, 0.52 } },
    chequered = { "cube", at = { 0.2, 0.1, 0.52 }, texture = checker { "red", "blue", size = 0.01 } },
  },
  observe = { images = "all", shadows = true },
  goal = is.on("green", "bench"),
  instructions = { "look" },
}
