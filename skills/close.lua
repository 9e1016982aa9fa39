-- Shut a drawer or door by its handle.
return skill {
  params = { "part: openable" },
  precondition = { is.hand_empty(), is_not.closed("part") },
  effect = { is.closed("part"), is_not.open("part") },
  continuous = {
    grasp = stream("grasps", "part"),                                   -- where to touch the handle
    speed = { 0.12, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "close the {part}",
  run = function(robot, p, c)
    robot:open_hand(0.05)
    robot:move_through { approach = c.grasp.approach, grasp = c.grasp.pose }
    robot:close_hand(p.part, { force = c.grasp.force })
    robot:move_part(p.part, 0, { speed = c.speed })
    robot:open_hand(0.05)
    robot:retreat(0.08)
  end,
}
