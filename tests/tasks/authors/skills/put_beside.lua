-- Set the held object down beside another one.
return skill {
  params = { "obj: movable", "other: movable", "table: support" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is.on("other", "table") },
  effect = { is.beside("obj", "other"), is.on("obj", "table"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.beside("obj", "other")) },
  label = "put the {obj} beside the {other}",
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot:offset(0, 0, 0.001))
    robot:move_through { approach = down:offset(0, 0, 0.08), place = down }
    robot:open_hand(robot:view():opening() + 0.02)
    robot:lift(0.08)
  end,
}
