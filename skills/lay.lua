-- Lay the held flat object down: its far edge first, then the hand lets go and draws back from under it.
return skill {
  params = { "obj: movable & flat", "to: surface" },
  precondition = { is.holding("obj") },
  effect = { is.on("obj", "to"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.leaning("obj", "to")) },    -- pose of the object as it touches down
  label = "lay the {obj} on the {to}",
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot)
    robot:move_through { approach = down:offset(0, 0, 0.06), place = down, ahead = down:along(0, 0, -0.06) }
    robot:wait(0.1)
    robot:open_hand(0.05)
    robot:retreat(0.06, { speed = 0.15 })                              -- it slides off the lower finger
  end,
}
