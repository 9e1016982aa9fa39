-- The object is held or hangs above the opening of a container, its middle within the opening.
return predicate {
  params = { "obj: movable", "box: container & hollow" },
  label = "the {obj} is over the {box}",
  settle = 0.1, -- s
  margin_unit = "m", -- how far it is from not being over it
  holds = function(w, obj, box)
    local x, y = w:position(obj)
    local inside = box .. ".inside"
    local _, _, z = w:position(inside)
    local over = math.min(w:bottom(obj) - w:top(inside), -w:region_distance(inside, x, y, z))
    return over >= 0, over
  end,
  sample = function(w, obj, box) -- as it is turned now, or turned as little as will do
    local inside = box .. ".inside"
    local x, y = w:position(inside)
    local _, _, middle = w:position(obj)
    local pose = w:pose(obj):with_position(x, y, w:top(inside) + middle - w:bottom(obj) + w:number(box, "gap", 0.015))
    local poses = {}
    for turn = 0, 180, 20 do
      poses[#poses + 1] = pose:turned(math.rad(turn))
      if turn > 0 and turn < 180 then poses[#poses + 1] = pose:turned(-math.rad(turn)) end
    end
    return poses
  end,
}
