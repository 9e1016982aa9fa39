-- Drag an object along the surface into a marked area with the tip of a tool: its last few centimetres lie flat along a
-- side of the object, so that it does not turn; one side after the other.
local strokes = require "worlds.lib.strokes"

local gap = 0.020    -- m from the side of the object to the middle of the tool, before it is touched
local high = 0.024   -- m above the surface: the middle of the tool
local beyond = 0.015 -- m that the tip reaches beyond the middle of the object's side, and half of that
local near = 0.010   -- m: what is left when it is there

-- A stroke of `way` m along a side of the object that is at x, y: to which of both sides the tool points is chosen by how far
-- out that brings the hand, which is `reach` from the tip. `worst`: how far out hand or object come.
local function stroke_of(side, way, x, y, reach, out)
  local sign = way > 0 and 1 or -1
  local best ---@type table
  for _, hand in ipairs { 1, -1 } do
    local one = { x = sign * side.x, y = sign * side.y, way = math.abs(way), half = side.half }
    one.worst = out(x + way * side.x, y + way * side.y)
    one.ax, one.ay = -one.y * hand, one.x * hand -- along the tool, out of the hand
    local back, off = side.half + gap, side.half + beyond - reach
    for _, gone in ipairs { -back, one.way - back } do
      one.worst = math.max(one.worst, out(x + gone * one.x + off * one.ax, y + gone * one.y + off * one.ay))
    end
    if not best or one.worst < best.worst then best = one end
  end
  return best
end

-- The next stroke: the first of those, along one side, then the other, perhaps half of the first way before and half
-- after, on which hand and object stay nearest to the middle of the surface.
local function next_stroke(w, p, reach)
  local x, y = w:position(p.obj)
  local goal_x, goal_y = w:position(p.area)
  local out, list, best, least = strokes.outness(w, p.top), strokes.sides(w, p.obj), nil, nil
  for first = 1, 2 do
    local way = {}
    for i, side in ipairs(list) do way[i] = (goal_x - x) * side.x + (goal_y - y) * side.y end
    local second = 3 - first
    for _, share in ipairs { 1, 0.5 } do
      local at_x, at_y, start, worst = x, y, nil, 0.0
      for _, one in ipairs { { first, share }, { second, 1 }, { first, 1 - share } } do
        local side, long = list[one[1]], way[one[1]] * one[2]
        if math.abs(long) >= near then
          local stroke = stroke_of(side, long, at_x, at_y, reach, out)
          at_x, at_y = at_x + long * side.x, at_y + long * side.y
          start, worst = start or stroke, math.max(worst, stroke.worst)
        end
      end
      if start and (not best or worst < least - 0.02) then best, least = start, worst end
    end
  end
  return best
end

return skill {
  params = { "tool: tool", "obj: movable", "area: pad", "top: surface" },
  moves = { "obj" },
  precondition = { is.holding("tool"), is.on("obj", "top"), is_not.covers("obj", "area") },
  effect = { is.covers("obj", "area") },
  continuous = { speed = { 0.12, min = 0.02, max = 0.2, unit = "m/s" } },
  label = "drag the {obj} onto the {area} with the {tool}",
  verbs = { "drag", "pull", "slide" },
  run = function(robot, p, c)
    local w = robot:view()
    local tip = p.tool .. ".tip"
    for _ = 1, 8 do
      local tx, ty, tz = w:pose(tip):inverse():times(robot:tip()):position()
      local stroke = next_stroke(w, p, math.sqrt(tx ^ 2 + ty ^ 2 + tz ^ 2))
      if not stroke then break end
      local x, y = w:position(p.obj)
      local out, back = stroke.half + beyond, stroke.half + gap
      local sx, sy = x + out * stroke.ax - back * stroke.x, y + out * stroke.ay - back * stroke.y
      local along = math.atan(stroke.ay, stroke.ax)
      local start = robot:tip_for(tip, pose(sx, sy, w:bottom(p.obj) + high, 0, math.pi / 2, along))
      local way = { (stroke.way + gap - 0.008) * stroke.x, (stroke.way + gap - 0.008) * stroke.y, 0 }
      local there = start:offset(way[1], way[2], 0)
      local off = { -0.02 * stroke.x, -0.02 * stroke.y, 0.06 }
      robot:move_through {
        { "approach", start:offset(0, 0, 0.06) }, { "goal", start },
        { "ahead", there }, { "ahead", there:offset(off[1], off[2], off[3]) },
      }
      robot:move_line(way, { speed = c.speed, most_force = 20 })
      robot:move_line(off)
    end
  end,
}
