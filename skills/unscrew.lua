-- Grip a cap or lid, turn it until its thread lets go of it, and lift it off.
return skill {
  params = { "obj: movable & threaded" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.joined("obj") },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.joined("obj"), is.lifted("obj") },
  continuous = {
    grasp = stream("grasps", "obj", "turn_to"),                         -- from which the wrist can turn far enough
    speed = { 0.08, min = 0.02, max = 0.2, unit = "m/s" },
    height = { 0.10, min = 0.02, max = 0.30, unit = "m" },
  },
  label = "unscrew the {obj}",
  verbs = { "unscrew", "open", "take", "remove", "turn" },
  run = function(robot, p, c)
    local goal = robot:view():number(p.obj, "turn_to")
    robot:open_hand(c.grasp.opening)
    robot:move_through({ approach = c.grasp.approach, grasp = c.grasp.pose }, { then_part = p.obj, to = goal, opening = c.grasp.width })
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:move_part(p.obj, goal, { speed = c.speed, most_force = 30 })
    robot:lift(c.height)
  end,
}
