-- Two cubes onto the tray, then a third is lifted, which nobody reaches.
return task {
  world = "tabletop",
  objects = {
    tray = { "tray", at = { 0.25, 0.20, 0.755 } },
    shelf = { "tray", at = { 0.80, 0, 0.755 } },
    a = { "cube", at = { 0.15, -0.10, 0.7705 } },
    b = { "cube", at = { 0.15, -0.25, 0.7705 } },
    far = { "cube", at = { 0.80, 0, 0.7755 } },
  },
  goal = { is.on("a", "tray"), is.on("b", "tray"), is.lifted("far") },
  instructions = { "put the cubes onto the tray and lift the far one" },
}
