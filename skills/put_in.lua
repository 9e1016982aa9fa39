-- Put the held object into an open drawer or box, from above.
return skill {
  params = { "obj: movable", "box: container & reach_in" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not.blocked("box"), any_of { is_not.openable("box"), is.open("box") } },
  effect = { is.inside("obj", "box"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.inside("obj", "box")) },    -- pose of the object
  label = "put the {obj} into the {box}",
  verbs = { "put", "lower", "drop", "insert", "stack", "slide", "push", "sort", "clear", "stand" },
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot:offset(0, 0, 0.005))
    robot:move_through { { "approach", down:offset(0, 0, 0.14) }, { "over", down:offset(0, 0, 0.06) }, { "ahead", down } }
    robot:move_line(down, { speed = 0.12, most_force = 20 })            -- what hangs askew in the hand may meet a wall
    robot:wait(0.1)
    robot:open_hand()
    robot:lift(0.14)
  end,
}
