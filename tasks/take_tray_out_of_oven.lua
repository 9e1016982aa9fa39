-- Take the baking tray out of the oven, which is shut, and put it on the table.
return task {
  objects = { oven = { "oven" }, tray = { "baking_tray" } },
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
