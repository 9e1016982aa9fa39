-- Slide one door of the cabinet open and put the cup behind it; the other door stays shut.
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
      is.on("cup", "table") }
  end,
  goal = function(v)
    return { is.inside("cup", "cabinet." .. v.side .. "_shelf"), is.open("cabinet." .. v.side .. "_door"), stays("others") }
  end,
  instructions = {
    "put the cup in the {side} half of the cabinet",
    "slide the {side} door open and place the cup behind it",
    "the cup lives in the cabinet, to the {side}",
    "store the cup behind the {side} door",
  },
}
