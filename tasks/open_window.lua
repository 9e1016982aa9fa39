-- Turn the handle of the window level and pull the window open.
return task {
  objects = { window = { "window" } },
  init = { is.closed("window.leaf"), is.workable("window.leaf") },
  goal = { is.open("window.leaf") },
  instructions = {
    "open the window",
    "turn the handle of the window and pull it open",
    "the room needs air: open the window",
    "swing the window towards you after turning its handle",
  },
}
