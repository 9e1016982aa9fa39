-- Hold the object in a place in the air: at its middle, or just well inside where there is room.
return skill {
  params = { "obj: movable", "zone: floating" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not.inside("obj", "zone") },
  effect = { is.inside("obj", "zone") },
  label = "lift the {obj} into the {zone}",
  verbs = { "lift", "hold", "remove" },
  run = function(robot, p)
    local w = robot:view()
    local zone, held = w:pose(p.zone), w:pose(p.obj)
    ---@type number[], number[]
    local at, size = { zone:inverse():times(held):position() }, { w:size(p.zone) }
    for i = 1, 3 do
      ---@type number
      local room = math.max(0, size[i] / 2 - 0.04) -- m from its middle; 4 cm from its faces
      at[i] = math.max(-room, math.min(room, at[i]))
    end
    local goal = zone:times(pose { at = at })
    robot:move_to(robot:tip_for(p.obj, held:with_position(goal:position())))
  end,
}
