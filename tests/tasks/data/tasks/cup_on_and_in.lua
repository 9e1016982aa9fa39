-- A cup that stands on the table in a zone much smaller than the table is lifted.
return task {
  world = "tabletop",
  objects = { cup = { "tumbler" }, zone = { "narrow_zone", at = { between(0.10, 0.28), between(-0.22, 0.22), 0.80 } }, cube = { "cube" } },
  init = { is.on("cube", "table"), is.on("cup", "table"), is.inside("cup", "zone"), is.spaced("cup", "cube") },
  goal = { is.holding("cup"), is.lifted("cup") },
  instructions = { "lift the cup" },
}
