-- As turn, along the arc of the joint, and with a hand that opens as it leaves.
return skill {
  extends = "turn",
  run = function(robot, p, c)
    local goal = robot:view():number(p.part, "turn_to")
    robot:open_hand(c.grasp.opening)
    robot:move_through({ approach = c.grasp.approach, grasp = c.grasp.pose }, { then_part = p.part, to = goal })
    robot:close_hand(p.part, { force = c.grasp.force })
    robot:follow({ { arc = goal - robot:view():joint(p.part), about = p.part, turn_speed = 0.8, name = "turned" } },
      { most_force = 30 })
    robot:retreat(0.10, { open = c.grasp.opening, speed = 0.05 })
  end,
}
