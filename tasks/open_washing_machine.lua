-- Open the round door of the washing machine.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { machine = { "washing_machine", place = places.round_the_table { gap = 0.14, turn = deg(45), lean = -0.16, wide = 0.36 } } },
  init = { is.closed("machine.door"), is.workable("machine.door") },
  goal = { is.open("machine.door") },
  instructions = {
    "open the washing machine",
    "pull the round door of the washing machine open",
    "the laundry is done: open the machine",
    "swing the door of the washing machine aside by its handle",
  },
}
