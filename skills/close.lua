-- Push a drawer or door shut, the tips of the closed fingers against its handle.
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
    local reach = 0.018 -- m from the middle of the handle back to the tip: the closed fingers just do not touch
    robot:close_hand()
    robot:move_through { approach = c.grasp.approach, goal = c.grasp.pose:along(0, 0, -reach) }
    robot:move_part(p.part, -0.005, { speed = c.speed }) -- pushes a little past the stop
    robot:retreat(0.08)
    robot:open_hand()
  end,
}
