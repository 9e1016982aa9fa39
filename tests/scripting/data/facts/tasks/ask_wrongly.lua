-- Tests that ask for facts that cannot be.
return task {
  world = "tabletop",
  objects = { item = { "cube", at = { 0.2, 0, 0.77 } } },
  goal = is.on("item", "table"),
  also = function(w) return w:fact("onn", "item", "table") end,
  fails = function(w) return w:observed("on", "item") end,
  instructions = { "leave it" },
}
