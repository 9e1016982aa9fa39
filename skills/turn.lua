-- Grasp a knob or the head of a tap and turn it about its axis.
return skill {
  params = { "part: turnable" },
  precondition = { is.hand_empty(), is_not.turned("part") },
  effect = { is.turned("part") },
  continuous = {
    grasp = stream("grasps", "part", "turn_to"),                        -- from which the wrist can turn far enough
    speed = { 0.08, min = 0.02, max = 0.2, unit = "m/s" },
  },
  label = "turn the {part}",
  run = function(robot, p, c)
    local w = robot:view()
    local goal = w:number(p.part, "turn_to")
    robot:open_hand(c.grasp.opening)
    robot:move_through({ approach = c.grasp.approach, grasp = c.grasp.pose },
      { then_part = p.part, to = goal, opening = c.grasp.width, retreat = 0.10 })
    robot:close_hand(p.part, { force = c.grasp.force })
    robot:move_part(p.part, goal, { speed = c.speed, most_force = 30, retreat = 0.10 })
    robot:open_hand(c.grasp.opening)
    robot:retreat(0.10)
  end,
}
