-- The bottle goes into the fridge, which is shut and is shut again.
local places = require "worlds.lib.places"

return task {
  objects = {
    fridge = { "fridge", place = places.right_or_across { gap = 0.13, turn = deg(16), lean = -0.16 } },
    bottle = { "water_bottle" },
  },
  init = { is.closed("fridge.door"), is.workable("fridge.door"), is.on("bottle", "table"), is_not.inside("bottle", "fridge.front") },
  goal = { is.inside("bottle", "fridge.shelf"), is.closed("fridge.door") },
  instructions = { "put the bottle into the fridge and shut it" },
}
