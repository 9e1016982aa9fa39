-- Turn the handle of the window level and pull the window open.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  objects = { window = { "window", place = places.beside_the_table { gap = 0.06, turn = deg(25), lean = 0.14, far = 0.16, wide = 0.44 } } },
  init = { is.closed("window.leaf"), is.workable("window.leaf") },
  goal = { is.open("window.leaf") },
  instructions = {
    "open the window",
    "turn the handle of the window and pull it open",
    "the room needs air: open the window",
    "swing the window towards you after turning its handle",
  },
}
