-- Take an object out of an open drawer or box, from above.
return skill {
  params = { "obj: movable & graspable", "box: container & reach_in" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.inside("obj", "box"), is_not.blocked("box"), any_of { is_not.openable("box"), is.open("box") } },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.inside("obj", "box"), is.lifted("obj") },
  continuous = {
    grasp = stream("grasps"),                                           -- of the object, reachable and free
    height = { 0.16, min = 0.08, max = 0.30, unit = "m" },
  },
  label = "take the {obj} out of the {box}",
  verbs = { "take", "find", "remove", "lift", "pull" },
  run = function(robot, p, c)
    robot:open_hand(c.grasp.opening)
    robot:move_through {
      approach = c.grasp.approach, grasp = c.grasp.pose, ahead = c.grasp.pose:offset(0, 0, c.height),
    }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:lift(c.height)
  end,
}
