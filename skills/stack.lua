-- Put the held object on top of another one, centred.
return skill {
  params = { "obj: movable", "below: stackable" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is.clear("below") },
  effect = { is.on("obj", "below"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.on("obj", "below")) },      -- pose of the object
  label = "stack the {obj} on the {below}",
  verbs = { "stack", "lower", "put", "insert", "build" },
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot:offset(0, 0, 0.001))
    local over = down:offset(0, 0, 0.05)                                -- a cup goes into another one from there on
    robot:move_through { { "approach", over:offset(0, 0, 0.03) }, { "over", over }, { "ahead", down } }
    robot:move_line(down, { speed = 0.12, most_force = 20 })            -- it may hang askew
    robot:wait(0.2)                                                     -- let the swing die before letting go
    robot:open_hand()
    robot:retreat(0.10)
  end,
}
