-- What is beside a thing while a hand takes it: it is to stay where it is.
local neighbours = {}

local near, moved = 0.25, 0.01 -- m

-- Where the movable things near one are, but those that are in it.
function neighbours.of(w, thing)
  local list, at = {}, w:pose(thing):inverse()
  for _, name in ipairs(w:objects("movable")) do
    if name ~= thing and w:distance(name, thing) < near and w:region_distance(thing, name) > 0 then
      list[#list + 1] = { name = name, pose = w:pose(name), seen_from_it = at:times(w:pose(name)) }
    end
  end
  return list
end

local function way(a, b)
  local x, y, z = a:position()
  local u, v, w = b:position()
  return math.sqrt((x - u) ^ 2 + (y - v) ^ 2 + (z - w) ^ 2)
end

-- The skill fails where one of them has been moved; what came along with the thing, as its lid does, has not.
function neighbours.stayed(robot, thing, list)
  local w = robot:view()
  local at = w:pose(thing):inverse()
  for _, one in ipairs(list) do
    local now = w:pose(one.name)
    if way(now, one.pose) > moved and way(at:times(now), one.seen_from_it) > moved then
      robot:fail("failed_by_skill", string.format("it moved %s by %.0f mm", one.name, 1000 * way(now, one.pose)))
    end
  end
end

return neighbours
