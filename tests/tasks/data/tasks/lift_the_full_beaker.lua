-- Lift the beaker with the peas that are in it.
return task {
  world = "tabletop",
  objects = { beaker = { "beaker" }, pea = { "pea", count = 2 } },
  init = { is.on("beaker", "table"), is.inside("pea*", "beaker.hold") },
  goal = { is.lifted("beaker"), is.inside("pea*", "beaker.hold") },
  instructions = { "lift the beaker, and leave the peas in it" },
}
