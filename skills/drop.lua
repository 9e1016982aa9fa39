-- Let the held object fall into something that is open at the top: a bin, a basket, a hoop.
return skill {
  params = { "obj: movable", "box: container & hollow" },
  moves = { "obj" },
  precondition = { is.holding("obj") },
  effect = { is.inside("obj", "box"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.over("obj", "box")) },      -- pose of the object, just above the rim
  label = "drop the {obj} into the {box}",
  verbs = { "drop", "lower", "put", "insert", "clear" },
  run = function(robot, p, c)
    local above = robot:tip_for(p.obj, c.spot)
    robot:move_through { approach = above:offset(0, 0, 0.06), place = above }
    robot:wait(0.1)
    robot:open_hand()
    robot:lift(0.08)
  end,
}
