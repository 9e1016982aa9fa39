-- Put the held object down so that its front points at something.
return skill {
  params = { "obj: movable & pointable", "aim: aim", "top: surface" },
  moves = { "obj" },
  precondition = { is.holding("obj") },
  effect = { is.pointing_at("obj", "aim"), is.on("obj", "top"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.pointing_at("obj", "aim")) },         -- pose of the object
  label = "put the {obj} down on the {top} so that it points at the {aim}",
  verbs = { "point" },
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot:offset(0, 0, 0.001))       -- released 1 mm above: never pressed in
    robot:move_through { approach = down:offset(0, 0, 0.08), place = down }
    robot:wait(0.1)
    robot:open_hand(robot:view():opening() + 0.02)
    robot:lift(0.08)
  end,
}
