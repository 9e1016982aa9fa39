-- Open the door of the fridge; the freezer above it stays shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { fridge = { "fridge", place = places.round_the_table { gap = 0.13, turn = deg(25), lean = -0.16, wide = 0.32 } } },
  init = { is.closed("fridge.door"), is.closed("fridge.freezer_door"), is.workable("fridge.door") },
  goal = { is.open("fridge.door"), stays("others") },
  instructions = {
    "open the fridge",
    "pull the door of the fridge open by its handle",
    "something must go into the fridge: open it",
    "let the large lower door of the fridge stand wide open",
  },
}
