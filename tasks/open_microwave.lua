-- Open the door of the microwave.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { microwave = { "microwave", place = places.round_the_table { gap = 0.13, turn = deg(22), lean = -0.14, wide = 0.36 } } },
  init = { is.closed("microwave.door"), is.workable("microwave.door") },
  goal = { is.open("microwave.door") },
  instructions = {
    "open the microwave",
    "pull the door of the microwave open by its handle",
    "something must go into the microwave: open it",
    "let the microwave stand wide open",
  },
}
