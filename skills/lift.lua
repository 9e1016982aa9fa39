-- Hold the object in a place in the air.
return skill {
  params = { "obj: movable", "zone: floating" },
  precondition = { is.holding("obj"), is_not.inside("obj", "zone") },
  effect = { is.inside("obj", "zone") },
  label = "lift the {obj} into the {zone}",
  run = function(robot, p)
    local zone = robot:view():pose(p.zone)
    robot:move_to(robot:tip_for(p.obj, robot:view():pose(p.obj):with_position(zone:position())))
  end,
}
