-- Go above a thing, whose position is taken for a table.
return skill {
  params = { "obj: cube", "zone: target" },
  precondition = { is.hand_empty() },
  effect = { is.at("zone") },
  label = "go above the {obj}",
  run = function(robot, p, c)
    local pos = robot:view():position(p.obj)
    robot:move_to(pose(pos.x, pos.y, pos.z + 0.1, math.pi, 0, 0))
  end,
}
