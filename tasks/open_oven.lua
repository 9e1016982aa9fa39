-- Swing the flap of the oven down.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { oven = { "oven", place = places.round_the_table { gap = 0.14, turn = deg(45), wide = 0.38 } } },
  init = { is.closed("oven.door"), is.workable("oven.door") },
  goal = { is.open("oven.door") },
  instructions = {
    "open the oven",
    "swing the flap of the oven down",
    "let the oven air: open its door",
    "pull the door of the oven down until it lies level",
  },
}
