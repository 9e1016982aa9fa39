-- Two cubes onto the tray, then one of two others is lifted; nobody reaches the far one.
return task {
  world = "tabletop",
  objects = {
    tray = { "tray", at = { 0.25, 0.20, 0.755 } },
    shelf = { "tray", at = { 0.80, 0, 0.755 } },
    a = { "cube", at = { 0.15, -0.10, 0.7705 } },
    b = { "cube", at = { 0.15, -0.25, 0.7705 } },
    far = { "cube", at = { 0.80, 0, 0.7755 } },
    near = { "cube", at = { 0.28, -0.18, 0.7705 } },
  },
  goal = { is.on("a", "tray"), is.on("b", "tray"), any_of { is.lifted("far"), is.lifted("near") } },
  instructions = { "put the cubes onto the tray and lift another one" },
}
