-- The cup goes behind one door of the cabinet, which is shut and is shut again.
return task {
  variations = { side = { "left", "right" } },
  objects = {
    cabinet = { "sliding_cabinet" },
    cup = { "tumbler", colour = one_of(colours.names) },
  },
  init = function(v)
    return { is.closed("cabinet.left_door"), is.closed("cabinet.right_door"), is.workable("cabinet." .. v.side .. "_door"),
      is.on("cup", "table") }
  end,
  goal = function(v)
    return { is.inside("cup", "cabinet." .. v.side .. "_shelf"), is.closed("cabinet." .. v.side .. "_door") }
  end,
  instructions = { "put the cup behind the {side} door of the cabinet and shut it" },
}
