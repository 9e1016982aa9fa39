-- Take the cube of one colour, by another name than that of its axis.
return task {
  world = "tabletop",
  variations = { color = { "red", "blue" } },
  objects = function(v)
    return { b = { "cube", colour = v.colour } }
  end,
  init = { is.on("b", "table") },
  goal = is.holding("b"),
  instructions = { "take the {color} cube" },
}
