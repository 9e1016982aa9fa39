-- Lift what is held by a height that nobody has declared.
return skill {
  params = { "obj: cube" },
  precondition = { is.holding("obj") },
  effect = { is.lifted("obj") },
  continuous = { speed = { 0.1, min = 0.01, max = 0.2, unit = "m/s" } },
  label = "lift the {obj}",
  run = function(robot, p, c)
    robot:lift(c.height, { speed = c.speed })
  end,
}
