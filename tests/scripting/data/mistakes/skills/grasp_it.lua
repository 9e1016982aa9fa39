-- Take a thing by a method that the robot has not got.
return skill {
  params = { "obj: cube" },
  precondition = { is.hand_empty() },
  effect = { is.holding("obj"), is_not.hand_empty() },
  label = "grasp the {obj}",
  run = function(robot, p, c)
    robot:grasp(p.obj)
  end,
}
