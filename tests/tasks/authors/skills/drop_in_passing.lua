-- As drop, but the hand opens over the bin without stopping there.
return skill {
  extends = "drop",
  run = function(robot, p, c)
    local over = robot:tip_for(p.obj, c.spot):offset(0, 0, 0.02)
    robot:move_to(over:offset(0, -0.12, 0.08))
    robot:follow({
      { to = over:offset(0, -0.02, 0), name = "over" },
      { by = { 0, 0.08, 0 }, open = 0.08, speed = 0.08 },
      { by = { 0, 0.04, 0.08 } },
    }, { blend = 0.02 })
  end,
}
