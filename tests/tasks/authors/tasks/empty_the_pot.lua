-- The pot goes onto the tray; the peg that stands in it has to be taken out first.
return task {
  world = "tabletop",
  skills = { "pick_empty" },
  objects = { tray = { "tray", at = { 0.30, -0.20, 0.755 } }, pot = { "pot" }, peg = { "dowel" } },
  init = { is.on("pot", "table"), is.in_slot("peg", "pot.hollow") },
  goal = { is.on("pot", "tray"), is_not.in_slot("peg", "pot.hollow"), is.hand_empty() },
  instructions = { "put the empty pot onto the tray" },
}
