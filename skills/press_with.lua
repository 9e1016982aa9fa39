-- Press a button, lever or plate with what is held, the way that it moves, to its contact point; then draw back. Its region
-- `spot` says where, as for `press`.
return skill {
  params = { "obj: movable", "button: pressable" },
  precondition = { is.holding("obj"), is_not.pressed_with("obj", "button") },
  effect = { is.pressed_with("obj", "button"), is.pressed("button") },
  continuous = {
    spot = stream(is.pressed_with("obj", "button")),                    -- pose of the object when it has pressed
    clear = { 0.03, min = 0.01, max = 0.10, unit = "m" },               -- how far before the button the straight way begins
    speed = { 0.08, min = 0.02, max = 0.2, unit = "m/s" },
    hold = { 0.3, min = 0.1, max = 2, unit = "s" },
  },
  label = "press the {button} with the {obj}",
  verbs = { "press", "push" },
  run = function(robot, p, c)
    local w = robot:view()
    local place = w:exists(p.button .. ".spot") and p.button .. ".spot" or p.button
    local _, most = w:joint_range(p.button)
    local down_there = w:part_at(p.button, (w:number(p.button, "on_at") + most) / 2) -- the button, between its switch and its stop
    local pressed = down_there:times(w:pose(p.button):inverse()):times(w:pose(place))
    local x, y, z = w:position(place)
    local px, py, pz = pressed:position()
    local further = 1 + c.clear / math.sqrt((px - x) ^ 2 + (py - y) ^ 2 + (pz - z) ^ 2)
    local way = { (px - x) * further, (py - y) * further, (pz - z) * further }
    local down = robot:tip_for(p.obj, c.spot)
    local before = down:offset(-way[1], -way[2], -way[3])
    local back = 2 -- of the way
    robot:move_through {
      { "approach", down:offset(-back * way[1], -back * way[2], -back * way[3]) }, { "goal", before }, { "ahead", down },
    }
    robot:move_line(down, { speed = c.speed, most_force = 10, keep_clear = true }) -- of all but the button
    robot:wait(c.hold)
    robot:move_line({ -back * way[1], -back * way[2], -back * way[3] }, { speed = 0.15 })
  end,
}
