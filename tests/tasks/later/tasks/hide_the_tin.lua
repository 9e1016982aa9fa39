-- The tin goes into one drawer of the chest, and that is shut again: nobody sees the tin any more.
return task {
  variations = { level = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest" },
    item = { "tin", colour = one_of(colours.names) },
  },
  init = function(v)
    return { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
      is.workable("chest." .. v.level .. "_drawer"), is.on("item", "table"), is.outside("item", "chest.front") }
  end,
  goal = function(v)
    local drawer = "chest." .. v.level .. "_drawer"
    return { is.inside("item", drawer), is.closed(drawer) }
  end,
  instructions = { "hide the tin in the {level} drawer" },
}
