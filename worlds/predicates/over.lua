-- The object is held or hangs above the opening of a container, its middle within the opening.

-- Places within the opening, {x, y}: its middle; where something is in there already, those around the middle, the furthest
-- from all of it first, for what falls on something may stay on top of it.
local function places(w, obj, inside)
  local x, y = w:position(inside)
  local within = {}
  for _, other in ipairs(w:objects("movable")) do
    if other ~= obj and w:inside(inside, other) then within[#within + 1] = other end
  end
  if #within == 0 then return { { x, y } } end
  local wide, deep = w:size(inside)
  local length, width = w:size(obj)
  local off = math.max(0, math.min(wide, deep) / 2 - math.max(length, width) / 2) * 0.7
  local around = {}
  for turn = 0, 315, 45 do
    local px, py = w:pose(inside):along(off * math.cos(math.rad(turn)), off * math.sin(math.rad(turn)), 0):position()
    local room = math.huge
    for _, other in ipairs(within) do
      local ox, oy = w:position(other)
      room = math.min(room, (ox - px) ^ 2 + (oy - py) ^ 2)
    end
    around[#around + 1] = { px, py, room }
  end
  table.sort(around, function(a, b) return a[3] > b[3] end)
  return { around[1], around[2], around[3] }
end

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
    local _, _, middle = w:position(obj)
    local z = w:top(inside) + middle - w:bottom(obj) + 0.015
    local poses = {}
    for _, place in ipairs(places(w, obj, inside)) do
      local pose = w:pose(obj):with_position(place[1], place[2], z)
      for turn = 0, 180, 20 do
        poses[#poses + 1] = pose:turned(math.rad(turn))
        if turn > 0 and turn < 180 then poses[#poses + 1] = pose:turned(-math.rad(turn)) end
      end
    end
    return poses
  end,
}
