-- Open one drawer of the chest and put the block inside.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { level = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest", place = places.round_the_table { gap = 0.12, turn = deg(22), wide = 0.26 } },
    item = { "cube", colour = one_of(colours.names) },
  },
  init = function(v)
    return { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
      is.workable("chest." .. v.level .. "_drawer"), is.on("item", "table"), is.outside("item", "chest.front") }
  end,
  goal = function(v) return { is.inside("item", "chest." .. v.level .. "_drawer") } end,
  instructions = {
    "store the cube in the {level} drawer of the chest",
    "the block belongs in the {level} drawer: open it and put the block there",
    "pull out the {level} drawer and lay the cube in it",
    "stow the block away in the {level} drawer",
  },
}
