-- Turn the lever of the door and pull the door open.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { doorway = { "doorway", place = places.beside_the_table { gap = 0.06, turn = deg(45), lean = -0.10, wide = 0.44 } } },
  init = { is.closed("doorway.door"), is.workable("doorway.door") },
  goal = { is.open("doorway.door") },
  instructions = {
    "open the door",
    "press the handle down and pull the door open",
    "turn the lever, then swing the door towards you",
    "let somebody in: open the door by its handle",
  },
}
