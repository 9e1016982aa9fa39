-- Put the baking tray that lies on the table into the oven, which is shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = {
    oven = { "oven", place = places.round_the_table { gap = 0.14, turn = deg(45), wide = 0.38 } },
    tray = { "baking_tray" },
  },
  init = {
    is.closed("oven.door"), is.workable("oven.door"), is.on("tray", "table"), is.outside("tray", "oven.front"),
    is.reachable_behind("tray", "oven.door"),
  },
  goal = { is.inside("tray", "oven.shelf") },
  instructions = {
    "put the tray in the oven",
    "open the oven and push the baking tray in",
    "the oven is for the tray that lies on the table: open it and put the tray in",
    "the tray belongs on the shelf of the oven",
  },
}
