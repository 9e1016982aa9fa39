-- Put the bottle that stands on the table into the fridge, which is shut.
local places = require "worlds.lib.places"

return task {
  objects = {
    fridge = { "fridge", place = places.right_or_across { gap = 0.13, turn = deg(16), lean = -0.16 } },
    bottle = { "water_bottle" },
  },
  init = { is.closed("fridge.door"), is.workable("fridge.door"), is.on("bottle", "table"), is_not.inside("bottle", "fridge.front") },
  goal = { is.inside("bottle", "fridge.shelf") },
  instructions = {
    "put the bottle in the fridge",
    "open the fridge and stand the bottle in it",
    "the water should be cold: it belongs in the fridge",
    "cool the bottle: stow it behind the big door of the fridge",
  },
}
