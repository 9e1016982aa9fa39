-- Its test reads one relation that it names, and by way of a variable one that it does not.
return task {
  world = "tabletop",
  objects = { item = { "cube", at = { 0.2, 0, 0.77 } }, other = { "cube", at = { 0.2, -0.2, 0.77 } } },
  goal = is.on("item", "table"),
  also = function(w) return w:fact("right_of", "item", "other") end,
  fails = function(w) return w:fact("left_" .. "of", "other", "item") end,
  instructions = { "leave it" },
}
