-- Something goes into the microwave, which is shut and is shut again.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { thing = { "tuna_can", "money", "steak" } },
  objects = function(v)
    return {
      microwave = { "microwave", place = places.behind_the_table { gap = 0.13, turn = deg(22), wide = 0.36 } },
      item = { v.thing },
    }
  end,
  init = { is.closed("microwave.door"), is.workable("microwave.door"), is.on("item", "table"),
    is_not.inside("item", "microwave.front") },
  goal = { is.inside("item", "microwave.shelf"), is.closed("microwave.door") },
  instructions = { "put the {thing} into the microwave and shut it" },
}
