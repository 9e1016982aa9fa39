-- Turn the lever of the door and pull the door open.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { doorway = { "doorway", place = places.beside_the_table(0.06, deg(45), 0.75, -0.10, nil, 0.44) } },
  init = { is.closed("doorway.door"), is.workable("doorway.door") },
  goal = { is.open("doorway.door"), is.hand_empty() },
  instructions = {
    "open the door",
    "press the handle down and pull the door open",
    "turn the lever, then swing the door towards you",
    "let somebody in: open the door by its handle",
  },
}
