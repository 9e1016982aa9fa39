-- Pull one drawer of the chest out; the other two stay shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { level = { "bottom", "middle", "top" } },
  objects = { chest = { "chest", place = places.round_the_table { gap = 0.12, turn = deg(22), wide = 0.26 } } },
  init = function(v)
    return { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
      is.workable("chest." .. v.level .. "_drawer") }
  end,
  goal = function(v) return { is.open("chest." .. v.level .. "_drawer"), stays("others") } end,
  instructions = {
    "pull out the {level} drawer of the chest",
    "the {level} drawer is wanted: open it by its handle",
    "open the {level} drawer and leave the others shut",
    "let the {level} drawer of the chest stand open",
  },
}
