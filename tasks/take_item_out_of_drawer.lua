-- Open the drawer that holds the block, take the block out and put it on the table.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { level = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest", place = places.round_the_table { gap = 0.12, turn = deg(22), wide = 0.26 } },
    item = { "cube", colour = one_of(colours.names) },
  },
  init = function(v)
    return { is.inside("item", "chest." .. v.level .. "_drawer"), is.workable("chest." .. v.level .. "_drawer"),
      is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer") }
  end,
  told = function(v) return { is.inside("item", "chest." .. v.level .. "_drawer") } end,
  goal = { is.on("item", "table") },
  instructions = {
    "take the block out of the {level} drawer and put it on the table",
    "a cube lies in the {level} drawer of the chest: bring it to the table",
    "empty the {level} drawer; its block belongs on the table",
    "open the {level} drawer, remove the cube and set it down on the table",
  },
}
