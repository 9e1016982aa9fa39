-- A stain on the table is wiped away with a sponge.
return task {
  world = "tabletop",
  objects = { stain = { "stain", at = { 0.28, between(-0.15, 0.15), 0.75 } }, sponge = { "sponge" } },
  init = { is.on("sponge", "table") },
  goal = is.wiped("stain"),
  instructions = { "wipe the stain away" },
}
