-- Slide a block past another one that balances on a post, which the slide knocks off; then put that one on the mat.
return task {
  world = "tabletop",
  objects = {
    item = { "cube", at = { 0.05, -0.05, 0.77 } },
    pole = { "pole", at = { 0.15, -0.022, 0.75 } },
    perched = { "cube", colour = "blue", at = { 0.15, -0.022, 0.794 } },
    area = { "marked_area", at = { 0.30, -0.05, 0.78 } },
    mat = { "mat", at = { 0.15, 0.22, 0.77 } },
  },
  init = { is.on("item", "table"), is.on("perched", "pole"), is_not.inside("item", "area") },
  goal = in_order { is.inside("item", "area"), is.on("perched", "mat") },
  instructions = { "slide the red block into the area, then put the blue one on the mat" },
}
