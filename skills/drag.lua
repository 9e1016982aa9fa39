-- Drag an object along the surface into a marked area with the tip of a tool: its last few centimetres lie flat along a side of
-- the object, so that it does not turn; one side after the other.
local gap = 0.020    -- m from the side of the object to the middle of the tool, before it is touched
local high = 0.024   -- m above the surface: the middle of the tool
local beyond = 0.015 -- m that the tip reaches beyond the middle of the object's side, and half of that
local near = 0.010   -- m: what is left when it is there

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

-- The next stroke: which way and how far, and to which side the tool points. Of all ways the one on which the hand stays
-- nearest to the middle of the surface.
local function next_stroke(w, p, reach)
  local x, y = w:position(p.obj)
  local goal_x, goal_y = w:position(p.area)
  local middle_x, middle_y = w:position(p.top)
  local best, least
  for _, side in ipairs(sides(w, p.obj)) do
    local way = (goal_x - x) * side.x + (goal_y - y) * side.y
    local ux, uy = way > 0 and side.x or -side.x, way > 0 and side.y or -side.y
    way = math.abs(way)
    for _, hand in ipairs(way >= near and { 1, -1 } or {}) do
      local ax, ay = -uy * hand, ux * hand -- along the tool, out of the hand
      local worst = 0
      for _, share in ipairs { 0, 1 } do
        local hx, hy = x + share * way * ux - reach * ax, y + share * way * uy - reach * ay
        worst = math.max(worst, math.sqrt((hx - middle_x) ^ 2 + (hy - middle_y) ^ 2))
      end
      if not best or worst < least then
        best, least = { x = ux, y = uy, way = way, along = math.atan(ay, ax), ax = ax, ay = ay, half = side.half }, worst
      end
    end
  end
  return best
end

return skill {
  params = { "tool: tool", "obj: movable", "area: marked", "top: surface" },
  moves = { "obj" },
  precondition = { is.holding("tool"), is.on("obj", "top"), is_not.covers("obj", "area") },
  effect = { is.covers("obj", "area") },
  continuous = { speed = { 0.12, min = 0.02, max = 0.2, unit = "m/s" } },
  label = "drag the {obj} onto the {area} with the {tool}",
  run = function(robot, p, c)
    local w = robot:view()
    local tip = p.tool .. ".tip"
    for _ = 1, 6 do
      local tx, ty, tz = w:pose(tip):inverse():times(robot:tip()):position()
      local stroke = next_stroke(w, p, math.sqrt(tx ^ 2 + ty ^ 2 + tz ^ 2))
      if not stroke then break end
      local x, y = w:position(p.obj)
      local out, back = stroke.half + beyond, stroke.half + gap
      local start = robot:tip_for(tip, pose(x + out * stroke.ax - back * stroke.x, y + out * stroke.ay - back * stroke.y,
        w:bottom(p.obj) + high, 0, math.pi / 2, stroke.along))
      local way = { (stroke.way + gap - 0.008) * stroke.x, (stroke.way + gap - 0.008) * stroke.y, 0 }
      local there = start:offset(way[1], way[2], 0)
      local off = { -0.02 * stroke.x, -0.02 * stroke.y, 0.06 }
      robot:move_through {
        { "approach", start:offset(0, 0, 0.06) }, { "goal", start }, { "ahead", there }, { "ahead", there:offset(off[1], off[2], off[3]) },
      }
      robot:move_line(way, { speed = c.speed, most_force = 20 })
      robot:move_line(off)
    end
  end,
}
