-- Shut the door of the microwave, which stands open.
local places = require "worlds.lib.places"

return task {
  objects = {
    microwave = { "microwave", place = places.round_the_table { gap = 0.13, turn = deg(22), wide = 0.36 },
      joints = { door = between(math.rad(30), math.rad(50)) } },
  },
  init = { is_not.closed("microwave.door"), is.workable("microwave.door") },
  goal = { is.closed("microwave.door") },
  instructions = {
    "close the microwave",
    "push the door of the microwave shut",
    "the microwave has been left open: shut it",
    "see to it that the microwave is closed",
  },
}
