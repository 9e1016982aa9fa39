-- For somebody who pours: how many are inside afterwards is promised, not which.
return skill {
  replaces = "drop",
  params = { "obj: food & movable", "box: container & hollow" },
  moves = { "obj" },
  precondition = { is.holding("obj") },
  effect = {
    at_least(1, "food", function(x) return is.inside(x, "box") end), is.hand_empty(), is_not.holding("obj"),
    is_not.lifted("obj"),
  },
  continuous = { spot = stream(is.over("obj", "box")) },
  label = "fill the {box}",
  run = function(robot, p, c)
    local above = robot:tip_for(p.obj, c.spot)
    robot:move_through { approach = above:offset(0, 0, 0.06), place = above }
    robot:open_hand()
    robot:lift(0.08)
  end,
}
