-- Slide the block into the marked area.
return task {
  world = "tabletop",
  objects = {
    item = { "cube", at = { between(0.12, 0.16), between(-0.05, 0.05), 0.77 } },
    area = { "marked_area", at = { 0.28, between(-0.12, 0.12), 0.78 } },
  },
  init = { is.on("item", "table"), is_not.inside("item", "area") },
  goal = { is.inside("item", "area"), is.on("item", "table") },
  steps = { act.push("item", "area", "table") }, -- nothing else than pushing is to be shown
  instructions = { "push the block into the yellow area" },
}
