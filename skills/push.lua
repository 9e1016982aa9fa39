-- Slide an object along the surface into a marked area with the closed fingers.
return skill {
  params = { "obj: movable", "area: marked & container", "top: surface" },
  precondition = { is.hand_empty(), is.on("obj", "top"), is_not.inside("obj", "area") },
  effect = { is.inside("obj", "area") },
  continuous = { speed = { 0.08, min = 0.02, max = 0.2, unit = "m/s" } },
  label = "push the {obj} into the {area}",
  run = function(robot, p, c)
    local w = robot:view()
    local x, y, z = w:position(p.obj)
    local goal_x, goal_y = w:position(p.area)
    local length = math.sqrt((goal_x - x) ^ 2 + (goal_y - y) ^ 2)
    local ux, uy = (goal_x - x) / length, (goal_y - y) / length
    local behind = math.max(w:size(p.obj)) / 2 + 0.03                   -- the tip starts this far behind the centre
    local start = robot:tip():with_position(x - ux * behind, y - uy * behind, z)
    robot:close_hand()
    robot:move_through { approach = start:offset(0, 0, 0.10), goal = start }
    robot:move_line({ ux * (length + 0.02), uy * (length + 0.02), 0 }, { speed = c.speed, tolerate = true })
    robot:lift(0.10)
  end,
}
