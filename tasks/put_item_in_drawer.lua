-- Open one drawer of the chest and put the block inside.
return task {
  variations = { level = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest" },
    item = { "cube", colour = one_of(colours.names) },
  },
  init = { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
    is.workable("chest.{level}_drawer"), is.on("item", "table"), is.outside("item", "chest.front") },
  goal = is.inside("item", "chest.{level}_drawer"),
  instructions = {
    "store the cube in the {level} drawer of the chest",
    "the block belongs in the {level} drawer: open it and put the block there",
    "pull out the {level} drawer and lay the cube in it",
    "stow the block away in the {level} drawer",
  },
}
