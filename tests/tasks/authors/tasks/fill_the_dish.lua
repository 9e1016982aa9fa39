-- Two of three beans go into the dish, by a skill that says only how many.
return task {
  world = "tabletop",
  skills = { "fill_some" },
  objects = { dish = { "deep_dish", at = { 0.25, between(-0.10, 0.10), 0.75 } }, bean = { "bean", count = 3 } },
  init = { is.on("bean*", "table") },
  goal = { at_least(2, "bean*", function(x) return is.inside(x, "dish") end), is.hand_empty() },
  instructions = { "fill the dish with two beans" },
}
