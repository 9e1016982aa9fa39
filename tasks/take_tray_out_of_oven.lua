-- Take the baking tray out of the oven, which is shut, and put it on the table.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = {
    oven = { "oven", place = places.round_the_table { gap = 0.14, turn = deg(45), wide = 0.38 } },
    tray = { "baking_tray" },
  },
  init = {
    is.closed("oven.door"), is.workable("oven.door"), is.inside("tray", "oven.shelf"), is.reachable_behind("tray", "oven.door"),
  },
  told = { is.inside("tray", "oven.shelf") },
  goal = { is.on("tray", "table") },
  instructions = {
    "take the tray out of the oven",
    "open the oven and put the baking tray on the table",
    "it is done: get the tray out of the oven",
    "move the tray from the oven to the table",
  },
}
