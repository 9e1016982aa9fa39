-- The lid of every box is brought down along its arc.
return task {
  world = "tabletop",
  objects = { crate = { "lidded_box", at = { 0.22, between(-0.10, 0.10), 0.75 }, joints = { lid = deg(100) } } },
  goal = { forall("?b: box", is.closed("?b.lid")), is.hand_empty() },
  instructions = { "shut every box" },
}
