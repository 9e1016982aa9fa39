-- Strokes that slide an object along a surface to a goal: side by side, so that it does not turn.
local strokes = {}

local worth = 0.02 -- a third stroke is, where hand and object stay so much further from the edge; 1 is from there to the middle

-- The level axes of the object, and how far it reaches along each.
local function sides(w, obj)
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
local function outness(w, top)
  local from_top = w:pose(top):inverse()
  local sx, sy = w:size(top)
  return function(x, y)
    local tx, ty = from_top:times(pose(x, y, 0)):position()
    return math.max(math.abs(tx) / sx, math.abs(ty) / sy) * 2
  end
end

-- The next stroke: the first of those, along one side, then the other, perhaps half of the first way before and half
-- after, on which hand and object go least far out on the surface. Nothing: less than `near` is left.
local function next_stroke(w, p, near, hand_out)
  local x, y = w:position(p.obj)
  local goal_x, goal_y = w:position(p.area)
  local out, list, best, least = outness(w, p.top), sides(w, p.obj), nil, nil
  for first, side in ipairs(list) do
    for _, share in ipairs { 1, 0.5 } do
      local at_x, at_y, start, worst = x, y, nil, 0
      for _, one in ipairs { { side, share }, { list[3 - first] or side, list[2] and 1 or 0 }, { side, 1 - share } } do
        local long = ((goal_x - x) * one[1].x + (goal_y - y) * one[1].y) * one[2]
        if math.abs(long) >= near then
          local sign = long > 0 and 1 or -1
          local stroke = { x = sign * one[1].x, y = sign * one[1].y, way = math.abs(long), half = one[1].half }
          local from = hand_out(stroke, at_x, at_y, out)
          at_x, at_y = at_x + long * one[1].x, at_y + long * one[1].y
          start, worst = start or stroke, math.max(worst, from, out(at_x, at_y))
        end
      end
      if share < 1 then worst = worst + worth end
      if start and (not best or worst < least) then best, least = start, worst end
    end
  end
  return best
end

-- Slides `p.obj` on `p.top` to the middle of `p.area`, until less than `near` m are left along each of its sides:
-- slide(stroke, x, y) makes one, `way` m along x and y of `stroke`, which reaches `half` m from the object's middle at x,
-- y. hand_out(stroke, x, y, out) says how far out(x, y) that brings the hand, and may choose how it goes.
function strokes.slide(robot, p, near, hand_out, slide)
  local w = robot:view()
  for _ = 1, 8 do
    local stroke = next_stroke(w, p, near, hand_out)
    if not stroke then break end
    slide(stroke, w:position(p.obj))
  end
end

return strokes
