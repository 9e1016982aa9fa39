-- Lay the held flat object down: its far edge first, then the hand lets go and draws back from under it.
return skill {
  params = { "obj: movable & flat", "to: surface" },
  moves = { "obj" },
  precondition = { is.holding("obj") },
  effect = { is.on("obj", "to"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.leaning("obj", "to")) },    -- pose of the object as it touches down
  label = "lay the {obj} on the {to}",
  verbs = { "put", "lower" },
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot)
    local over = down:offset(0, 0, 0.015)
    robot:move_through { { "approach", down:offset(0, 0, 0.06) }, { "place", over }, { "ahead", down:along(0, 0, -0.06) } }
    robot:move_line(down, { speed = 0.1, most_force = 8 })             -- until its edge rests
    robot:wait(0.1)
    robot:open_hand(0.05)
    robot:retreat(0.06, { speed = 0.15 })                              -- it slides off the lower finger
  end,
}
