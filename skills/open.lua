-- Pull a drawer or door open by its handle.
return skill {
  params = { "part: openable" },
  precondition = { is.hand_empty(), is_not.open("part") },
  effect = { is.open("part"), is_not.closed("part") },
  continuous = {
    grasp = stream("grasps", "part", "pull"),                           -- of the handle, from which it can be pulled
    speed = { 0.12, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "open the {part}",
  run = function(robot, p, c)
    local w = robot:view()
    robot:open_hand(0.05)
    local pulled = w:part_at(p.part, w:number(p.part, "pull")):times(w:pose(p.part):inverse()):times(c.grasp.pose)
    robot:move_through { approach = c.grasp.approach, grasp = c.grasp.pose, ahead = pulled }
    robot:close_hand(p.part, { force = c.grasp.force })
    robot:move_part(p.part, w:number(p.part, "pull"), { speed = c.speed, most_force = 40 })
    robot:open_hand(0.05)
    robot:retreat(0.08)
  end,
}
