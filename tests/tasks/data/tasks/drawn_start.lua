-- Shut the chest; how it starts is drawn from what init says.
return task {
  world = "tabletop",
  objects = {
    chest = { "chest", at = { 0.52, 0.05, 0.75 } },
    block = { "cube", colour = "red", count = 3 },
  },
  init = {
    is.on("block*", "table"),
    exists("?b: block*", "?c: block*", is.on("?b", "?c")),
    any_of { is.open("chest.top_drawer"), is.open("chest.middle_drawer") },
  },
  goal = { is.closed("chest.top_drawer"), is.closed("chest.middle_drawer") },
  instructions = { "shut the chest" },
}
