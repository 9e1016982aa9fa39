-- What strokes along a surface have in common: the sides of what is slid, and how near the edge it comes.
local strokes = {}

-- The level axes of the object, and how far it reaches along each.
function strokes.sides(w, obj)
  local at, size, list = w:pose(obj), { w:size(obj) }, {}
  local x, y = at:position()
  for i, axis in ipairs { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } do
    local ax, ay = at:along(axis[1], axis[2], axis[3]):position()
    local length = math.sqrt((ax - x) ^ 2 + (ay - y) ^ 2)
    if length > 0.9 then list[#list + 1] = { x = (ax - x) / length, y = (ay - y) / length, half = size[i] / 2 } end
  end
  return list
end

-- How far out on the surface a point is: 1 at the edge.
function strokes.outness(w, top)
  local from_top = w:pose(top):inverse()
  local sx, sy = w:size(top)
  return function(x, y)
    local tx, ty = from_top:times(pose(x, y, 0)):position()
    return math.max(math.abs(tx) / sx, math.abs(ty) / sy) * 2
  end
end

return strokes
