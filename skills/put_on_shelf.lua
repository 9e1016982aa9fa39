-- Put the held object on a shelf from its open front.
return skill {
  params = { "obj: movable", "shelf: container & shelf" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not.blocked("shelf") },
  effect = { is.inside("obj", "shelf"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.inside("obj", "shelf")) },  -- pose of the object
  label = "put the {obj} on the {shelf}",
  verbs = { "put", "lower", "slide", "stand" },
  run = function(robot, p, c)
    local shelf = robot:view():pose(p.shelf)
    local x, y = shelf:position()
    local out_x, out_y = shelf:along(-0.17, 0, 0):position()            -- out of the front, which is its -x
    out_x, out_y = out_x - x, out_y - y
    local down = robot:tip_for(p.obj, c.spot)
    local over = down:offset(0, 0, 0.015)
    robot:move_through {
      { "before", over:offset(out_x, out_y, 0) }, { "over", over }, { "ahead", down }, { "ahead", down:offset(out_x, out_y, 0) },
    }
    robot:move_line(down, { speed = 0.1, most_force = 15 })             -- it sags a little in a slanting hand
    robot:wait(0.1)
    robot:open_hand()
    robot:move_line { out_x, out_y, 0 }
  end,
}
