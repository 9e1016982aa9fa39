-- Put the baking tray that lies on the table into the oven, which is shut.
return task {
  objects = { oven = { "oven" }, tray = { "baking_tray" } },
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
