-- Shut the door of the fridge, which stands open; the freezer above it stays shut.
local places = require "worlds.lib.places"

return task {
  objects = {
    fridge = { "fridge", place = places.round_the_table { gap = 0.13, turn = deg(45), wide = 0.32 },
      joints = { door = between(math.rad(32), math.rad(50)) } },
  },
  init = { is_not.closed("fridge.door"), is.closed("fridge.freezer_door"), is.workable("fridge.door") },
  goal = { is.closed("fridge.door"), stays("others") },
  instructions = {
    "close the fridge",
    "the cold gets out: push the door of the fridge shut",
    "shut the lower door of the refrigerator",
    "somebody left the fridge open: close it",
  },
}
