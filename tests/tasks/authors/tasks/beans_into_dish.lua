-- Any three of four beans go into the dish.
return task {
  world = "tabletop",
  objects = { dish = { "deep_dish", at = { 0.25, between(-0.10, 0.10), 0.75 } }, bean = { "bean", count = 4 } },
  init = { is.on("bean*", "table") },
  goal = { at_least(3, "bean*", function(x) return is.inside(x, "dish") end), is.hand_empty() },
  instructions = { "put three beans into the dish" },
}
