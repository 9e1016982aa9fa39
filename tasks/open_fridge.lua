-- Open the door of the fridge; the freezer above it stays shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { fridge = { "fridge", place = places.round_the_table(0.13, deg(25), 0.75, -0.16, 0.32) } },
  init = { is.closed("fridge.door"), is.closed("fridge.freezer_door"), is.workable("fridge.door") },
  goal = { is.open("fridge.door"), is.closed("fridge.freezer_door"), is.hand_empty() },
  instructions = {
    "open the fridge",
    "pull the door of the fridge open by its handle",
    "something must go into the fridge: open it",
    "let the large lower door of the fridge stand wide open",
  },
}
