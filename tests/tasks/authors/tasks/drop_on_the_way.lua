-- The rubbish falls into the bin while the hand moves on.
return task {
  world = "tabletop",
  skills = { "drop_in_passing" },
  objects = { bin = { "bin", at = { 0.25, 0.15, 0.75 } }, rubbish = { "rubbish", at = { 0.15, -0.2, 0.78 } } },
  goal = { is.inside("rubbish", "bin"), is.hand_empty() },
  instructions = { "throw the paper away" },
}
