-- Take a thing, and forget that the hand is full then.
return skill {
  params = { "obj: cube", "from: support" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.on("obj", "from") },
  effect = { is.holding("obj"), is_not.on("obj", "from") },
  continuous = { grasp = stream("grasps") },
  label = "take the {obj}",
  run = function(robot, p, c)
    robot:open_hand(c.grasp.opening)
    robot:move_through { approach = c.grasp.approach, grasp = c.grasp.pose }
    robot:close_hand(p.obj)
  end,
}
