-- Something flat goes into one drawer of the chest, and that is shut again.
return task {
  variations = { thing = { "money", "steak" }, level = { "bottom", "middle", "top" } },
  objects = function(v)
    return {
      chest = { "chest" },
      item = { v.thing },
    }
  end,
  init = function(v)
    return { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
      is.workable("chest." .. v.level .. "_drawer"), is.on("item", "table"), is.outside("item", "chest.front") }
  end,
  goal = function(v)
    local drawer = "chest." .. v.level .. "_drawer"
    return { is.inside("item", drawer), is.closed(drawer) }
  end,
  instructions = { "put the {thing} into the {level} drawer and shut it" },
}
