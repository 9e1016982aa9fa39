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
    robot:move_through({ { "second", c.grasp.pose }, { "first", c.grasp.approach } },
      { then_follow = { { by = { 0, 0, 0.1 } }, { tilt = 2, turn_speed = 0.5 } } })
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:lift(c.height)
    robot:move_line({ 0.1, 0, 0 }, { speed = 0.05, stop_on_contact = true, force = 7, tolerate = true })
    robot:retreat(0.08)
    robot:move_to(robot:tip():offset(0, 0, 0.25):rotated(0, 0, deg(90)))
    robot:move_part("chest.drawer", 0.1, { speed = 0.2, pivot = 0.5 })
    local reach = robot:reach_of_part("chest.drawer", 0.15, { pivot = 0.2, retreat = 0.05 })
    assert(reach == 0.125)
    local grasp = robot:find_grasp("chest.drawer", 0.15)
    assert(grasp.reach == 0.0625 and grasp.force == 12)
    assert(robot:find_grasp("chest.drawer", 0.2) == nil)
    robot:move_part("chest.drawer", reach, { as_far_as_it_goes = true })
    robot:move_line({ 0, 0.1, 0 }, { press = 8, press_along = { 0, 0, -2 }, open = 0.03 })
    robot:move_line({ 0, 0, -0.04 }, { search = 0.004, pitch = 0.001 })
    robot:follow({
      { by = { 0, 0, 0.1 }, open = 0.05, speed = 0.4 },
      { to = robot:tip():offset(0, 0.2, 0), stop = true, name = "over" },
      { arc = deg(90), axis = { 0, 0, 3 }, about = p.obj, turn = false },
      { arc = -1, axis = { 1, 0, 0 }, about = { 0.1, 0.2, 0.3 } },
      { tilt = 2, about = { 0, 0, 0.05 }, turn_speed = 0.5 },
      { tilt = 1, axis = { 0, 1, 0 }, about = robot:tip() },
      { open = 0.01 },
    }, { blend = 0.02, press = 5, most_force = 30, turn_speed = 2 })
    robot:tilt(-1.5, { axis = { 1, 0, 0 }, about = p.obj, speed = 0.1, name = "poured" })
    robot:wait(0.5)
    robot:move_home()
    robot:run(act.counting { "top", to = "bench" })
    robot:move_to(robot:tip_for(p.obj, robot:view():pose(p.obj):offset(0, 0, 1)))
    robot:fail("no_grasp", "as planned")
  end,
}
