-- Put the red cube to the named side of the blue one, and near it.
return task {
  world = "tabletop",
  variations = { side = { "left_of", "right_of", "in_front_of", "beyond" } },
  objects = { red_cube = { "cube", colour = "red" }, blue_cube = { "cube", colour = "blue" } },
  init = { is.on("red_cube", "table"), is.on("blue_cube", "table") },
  goal = function(v) return { is[v.side]("red_cube", "blue_cube"), is.near("red_cube", "blue_cube") } end,
  instructions = function(v)
    local words = { left_of = "to the left of", right_of = "to the right of", in_front_of = "in front of", beyond = "beyond" }
    return { "put the red cube " .. words[v.side] .. " the blue cube, near it" }
  end,
}
