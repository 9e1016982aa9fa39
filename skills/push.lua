-- Slide an object along the surface into a marked area with the closed fingers: side by side, so that it does not turn.
local gap = 0.024    -- m from the side of the object back to the tip, before it is touched
local near = 0.012   -- m: what is left when it is there

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

-- How far out on the surface the tip is behind an object at x, y that is pushed along a side: 1 at the edge.
local function off_centre(w, top, x, y, side, way)
  local cx, cy = w:position(top)
  local sx, sy = w:size(top)
  local back = way > 0 and side.half + gap or -side.half - gap
  return math.max(math.abs(x - back * side.x - cx) / sx, math.abs(y - back * side.y - cy) / sy) * 2
end

-- The side to push first, and how far: of two ways round, the one on which the hand stays nearer to the middle.
local function first_side(w, p, goal_x, goal_y)
  local x, y = w:position(p.obj)
  local left = {}
  for _, side in ipairs(sides(w, p.obj)) do
    local way = (goal_x - x) * side.x + (goal_y - y) * side.y
    if math.abs(way) >= near then left[#left + 1] = { side = side, way = way } end
  end
  local best, least
  for i, a in ipairs(left) do
    local out = off_centre(w, p.top, x, y, a.side, a.way)
    local b = left[3 - i]
    if b then
      out = math.max(out, off_centre(w, p.top, x + a.way * a.side.x, y + a.way * a.side.y, b.side, b.way))
    end
    if not best or out < least then best, least = a, out end
  end
  if best then return best.side, best.way end
end

return skill {
  params = { "obj: movable", "area: marked & container", "top: surface" },
  precondition = { is.hand_empty(), is.on("obj", "top"), is_not.inside("obj", "area") },
  effect = { is.inside("obj", "area") },
  continuous = { speed = { 0.12, min = 0.02, max = 0.2, unit = "m/s" } },
  label = "push the {obj} into the {area}",
  run = function(robot, p, c)
    local w = robot:view()
    local goal_x, goal_y = w:position(p.area)
    robot:close_hand()
    for _ = 1, 5 do
      local side, way = first_side(w, p, goal_x, goal_y)
      if not side then break end
      local x, y = w:position(p.obj)
      local ux, uy = side.x, side.y
      if way < 0 then ux, uy, way = -ux, -uy, -way end
      local _, _, turn = robot:tip():rpy()
      local yaw = math.atan(uy, ux)
      if math.cos(yaw - turn) < 0 then yaw = yaw + math.pi end          -- front and back of the fingers are alike
      local behind = side.half + gap
      local z = w:bottom(p.obj) + math.max(0.012, math.min(0.02, (w:top(p.obj) - w:bottom(p.obj)) / 2))
      local start = pose(x - ux * behind, y - uy * behind, z, math.pi, 0, yaw)
      robot:move_through { approach = start:offset(0, 0, 0.08), goal = start }
      robot:move_line({ ux * (way + 0.015), uy * (way + 0.015), 0 }, { speed = c.speed, tolerate = true })
      robot:move_line { -0.02 * ux, -0.02 * uy, 0.07 }
    end
    robot:open_hand()
  end,
}
