-- Rub a marked area with the closed fingers, held down with a force, wherever exactly the surface is.
return skill {
  params = { "area: marked" },
  precondition = { is.hand_empty() },
  effect = { is.rubbed("area") },
  continuous = { force = { 8, min = 2, max = 20, unit = "N" }, wrong = { 0, min = -0.005, max = 0.005, unit = "m" } },
  label = "rub the {area}",
  run = function(robot, p, c)
    local x, y, z = robot:view():position(p.area)
    local start = pose(x - 0.05, y - 0.05, z + 0.009 + 0.006 + c.wrong, math.pi, 0, 0)
    robot:close_hand()
    robot:move_through { approach = start:offset(0, 0, 0.06), goal = start }
    robot:follow({
      { by = { 0.10, 0, 0 }, name = "far" }, { by = { 0, 0.05, 0 } }, { by = { -0.10, 0, 0 } },
      { arc = math.pi, axis = { 0, 0, -1 }, about = { x - 0.05, y + 0.025, z }, turn = false, name = "round" },
    }, { press = c.force, speed = 0.08, blend = 0.015 })
    robot:lift(0.08)
    robot:tilt(0.6, { axis = { 1, 0, 0 } })                             -- and look at the fingers
    robot:open_hand()
  end,
}
