-- Take an object off a shelf through its open front.
return skill {
  params = { "obj: movable & graspable", "shelf: container & shelf" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.inside("obj", "shelf"), is_not.blocked("shelf") },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.inside("obj", "shelf"), is.lifted("obj") },
  continuous = { grasp = stream("grasps") },                            -- of the object, reachable and free
  label = "take the {obj} off the {shelf}",
  verbs = { "take", "remove" },
  run = function(robot, p, c)
    local shelf = robot:view():pose(p.shelf)
    local x, y = shelf:position()
    local out_x, out_y = shelf:along(-0.12, 0, 0):position()            -- out of the front, which is its -x
    robot:open_hand(c.grasp.opening)
    robot:move_through { approach = c.grasp.approach, grasp = c.grasp.pose }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:retreat(0.06)                                                 -- back and up, the way it came
    robot:move_to(robot:tip():offset(out_x - x, out_y - y, 0.02))
  end,
}
