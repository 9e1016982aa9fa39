-- Slide one of the two doors of the cabinet open; the other one stays shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { side = { "left", "right" } },
  objects = { cabinet = { "sliding_cabinet", place = places.round_the_table { gap = 0.13, turn = deg(16) } } },
  init = function(v)
    return { is.closed("cabinet.left_door"), is.closed("cabinet.right_door"), is.workable("cabinet." .. v.side .. "_door") }
  end,
  goal = function(v)
    return { is.open("cabinet." .. v.side .. "_door"), stays("others") }
  end,
  instructions = {
    "slide the {side} door of the cabinet open",
    "push the {side} door aside by its handle",
    "open the {side} half of the cabinet",
    "the {side} door has to go: slide it to the side and leave the other one shut",
  },
}
