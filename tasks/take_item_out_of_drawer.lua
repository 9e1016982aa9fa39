-- Open the drawer that holds the block, take the block out and put it on the table.
return task {
  variations = { level = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest" },
    item = { "cube", colour = one_of(colours.names) },
  },
  init = { is.inside("item", "chest.{level}_drawer"), is.workable("chest.{level}_drawer"),
    is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer") },
  told = { is.inside("item", "chest.{level}_drawer") },
  goal = { is.on("item", "table") },
  instructions = {
    "take the block out of the {level} drawer and put it on the table",
    "a cube lies in the {level} drawer of the chest: bring it to the table",
    "empty the {level} drawer; its block belongs on the table",
    "open the {level} drawer, remove the cube and set it down on the table",
  },
}
