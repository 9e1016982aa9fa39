-- Turn the oven on: the knob in the middle of the cooker's panel, by a quarter turn.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { cooker = { "cooker", place = places.round_the_table { gap = 0.13, turn = deg(45), wide = 0.40 } } },
  init = { is_not.turned("cooker.oven_knob"), is.workable_by_turning("cooker.oven_knob") },
  goal = { is.turned("cooker.oven_knob") },
  instructions = {
    "turn the oven on",
    "switch on the oven with the knob in the middle",
    "the oven has to heat up: turn its knob by a quarter",
    "turn the middle knob of the cooker, the one with the red mark",
  },
}
