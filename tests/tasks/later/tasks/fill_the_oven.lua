-- Something goes into the oven, which is shut and is shut again.
return task {
  variations = { thing = { "baking_tray", "steak", "money", "soup_can" } },
  objects = function(v)
    return {
      oven = { "oven" },
      item = { v.thing },
    }
  end,
  init = {
    is.closed("oven.door"), is.workable("oven.door"), is.on("item", "table"), is.outside("item", "oven.front"),
    is.reachable_behind("item", "oven.door"),
  },
  goal = { is.inside("item", "oven.shelf"), is.closed("oven.door") },
  instructions = { "put the {thing} into the oven and shut it" },
}
