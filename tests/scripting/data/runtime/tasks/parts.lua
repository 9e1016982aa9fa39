-- Subgoals in their order, with sentences and without.
return task {
  world = "bench",
  variations = { colour = { "red", "blue" }, where = { "on_it", "off_it" } },
  objects = function(v) return { cube = { "cube", colour = v.colour, at = { 0, 0.1, 0.52 } } } end,
  goal = is.holding("cube"),
  subgoals = {
    { "zebra", is.on("cube", "bench"), "leave the {colour} cube {where}" },
    { "ape", is.holding("cube") },
  },
  instructions = { "take the {colour} cube" },
}
