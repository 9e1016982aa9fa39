-- Put the held object down on a free spot of a surface.
return skill {
  params = { "obj: movable", "to: surface" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not.flat("obj") },             -- what is flat is laid
  effect = { is.on("obj", "to"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = { spot = stream(is.on("obj", "to")) },         -- pose of the object
  label = "put the {obj} on the {to}",
  verbs = { "put", "lower", "insert", "stack", "build", "slide", "sort", "weigh", "clear", "stand" },
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.spot:offset(0, 0, 0.001))       -- released 1 mm above: never pressed in
    robot:move_through { approach = down:offset(0, 0, 0.08), place = down, ahead = down:along(0, 0, -0.08) }
    robot:wait(0.1)
    robot:open_hand(robot:view():opening() + 0.02)                      -- no wider: there may be neighbours
    local _, _, z = robot:tip():position()
    local _, _, finger_z = robot:tip():along(0, 0.1, 0):position()
    if math.abs(finger_z - z) < 0.01 then                               -- no finger is below the object:
      robot:lift(0.08)                                                  -- back the way it came
    else
      robot:retreat(0.08)
    end
  end,
}
