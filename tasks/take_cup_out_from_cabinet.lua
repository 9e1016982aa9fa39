-- Slide the door open behind which the cup stands, and put the cup on the table; the other door stays shut.
return task {
  variations = { side = { "left", "right" } },
  objects = {
    cabinet = { "sliding_cabinet" },
    cup = { "tumbler", colour = one_of(colours.names) },
  },
  init = { is.closed("cabinet.left_door"), is.closed("cabinet.right_door"), is.workable("cabinet.{side}_door"),
    is.inside("cup", "cabinet.{side}_shelf") },
  told = { is.inside("cup", "cabinet.{side}_shelf") },
  goal = function(v)
    return { is.on("cup", "table"), is.closed("cabinet." .. (v.side == "left" and "right" or "left") .. "_door") }
  end,
  instructions = {
    "take the cup out of the {side} half of the cabinet",
    "slide the {side} door open and put the cup from behind it on the table",
    "get the cup that stands in the cabinet, to the {side}",
    "behind the {side} door is a cup: it should stand on the table",
  },
}
