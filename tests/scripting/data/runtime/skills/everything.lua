-- Calls every method of the robot once, in an order that the test knows.
return skill {
  params = { "obj: movable", "to: surface" },
  precondition = { is.hand_empty() },
  effect = { is.holding("obj") },
  continuous = { grasp = stream("grasps"), height = { 0.1, min = 0.02, max = 0.3, unit = "m" }, push = { { 1, 2, 3 }, unit = "N" } },
  controller = "joint_impedance",
  label = "do everything with the {obj}",
  run = function(robot, p, c)
    assert(p.obj == "cube" and p.to == "bench" and p.hand == "mini.hand")
    assert(c.controller == "joint_impedance" and c.stiffness == 40)
    assert(c.push[1] == 1 and c.push[3] == 3)
    robot:open_hand()
    robot:open_hand(0.02)
    robot:move_through { grasp = c.grasp.pose, approach = c.grasp.approach }
    robot:move_through { { "second", c.grasp.pose }, { "first", c.grasp.approach } }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:lift(c.height)
    robot:move_line({ 0.1, 0, 0 }, { speed = 0.05, stop_on_contact = true, force = 7, tolerate = true })
    robot:retreat(0.08)
    robot:move_to(robot:tip():offset(0, 0, 0.25):rotated(0, 0, deg(90)))
    robot:move_part("chest.drawer", 0.1, { speed = 0.2, pivot = 0.5 })
    robot:wait(0.5)
    robot:move_home()
    robot:run(act.counting { "top", to = "bench" })
    robot:move_to(robot:tip_for(p.obj, robot:view():pose(p.obj):offset(0, 0, 1)))
    robot:fail("no_grasp", "as planned")
  end,
}
