-- Slide the door open behind which the cup stands, and put the cup on the table; the other door stays shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { side = { "left", "right" } },
  objects = {
    cabinet = { "sliding_cabinet", place = places.round_the_table { gap = 0.13, turn = deg(16) } },
    cup = { "tumbler", colour = one_of(colours.names) },
  },
  init = function(v)
    return { is.closed("cabinet.left_door"), is.closed("cabinet.right_door"), is.workable("cabinet." .. v.side .. "_door"),
      is.inside("cup", "cabinet." .. v.side .. "_shelf") }
  end,
  told = function(v) return { is.inside("cup", "cabinet." .. v.side .. "_shelf") } end,
  goal = function(v)
    return { is.on("cup", "table"), is.closed("cabinet." .. (v.side == "left" and "right" or "left") .. "_door") }
  end,
  instructions = {
    "take the cup out of the {side} half of the cabinet",
    "slide the {side} door open and put the cup from behind it on the table",
    "get the cup that stands in the cabinet, to the {side}",
    "behind the {side} door is a cup: it should stand on the table",
  },
}
