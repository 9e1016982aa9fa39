-- Slide an object along the surface into a marked area with the closed fingers: side by side, so that it does not turn.
local strokes = require "worlds.lib.strokes"

local gap = 0.024    -- m from the side of the object back to the tip, before it is touched
local safe = 0.75     -- how far out on a surface an object's middle may be; 1 is the edge
local near = 0.012   -- m: what is left when it is there

-- The side to push next, and how far: of two ways round, the one on which hand and object stay nearer to the middle.
-- Where both lead over the edge, the object goes a part of the way only: the rest in steps.
local function next_push(w, p, goal_x, goal_y)
  local x, y = w:position(p.obj)
  local out = strokes.outness(w, p.top)
  local best, least
  local all = strokes.sides(w, p.obj)
  for i, side in ipairs(all) do
    local way = (goal_x - x) * side.x + (goal_y - y) * side.y
    if math.abs(way) >= near then
      local back = way > 0 and side.half + gap or -side.half - gap
      local worst, other = out(x - back * side.x, y - back * side.y), all[3 - i]
      local at_x, at_y = x + way * side.x, y + way * side.y
      if other then
        local left = (goal_x - at_x) * other.x + (goal_y - at_y) * other.y
        local behind = math.abs(left) < near and 0 or left > 0 and other.half + gap or -other.half - gap
        worst = math.max(worst, out(at_x - behind * other.x, at_y - behind * other.y), out(at_x, at_y))
      end
      local here = math.max(out(x, y), safe)
      while math.abs(way) > 0.03 and out(x + way * side.x, y + way * side.y) > here do way = 0.8 * way end
      if not best or worst < least then best, least = { side, way }, worst end
    end
  end
  if best then return best[1], best[2] end
end

return skill {
  params = { "obj: movable", "area: marked & container", "top: surface" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.on("obj", "top"), is_not.inside("obj", "area") },
  effect = { is.inside("obj", "area") },
  forgets = { "covers" },                                               -- of this area or of another on the way
  continuous = { speed = { 0.12, min = 0.02, max = 0.2, unit = "m/s" } },
  label = "push the {obj} into the {area}",
  verbs = { "push", "press", "slide" },
  run = function(robot, p, c)
    local w = robot:view()
    local goal_x, goal_y = w:position(p.area)
    robot:close_hand()
    for _ = 1, 8 do
      local side, way = next_push(w, p, goal_x, goal_y)
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
      robot:move_line({ ux * (way + 0.015), uy * (way + 0.015), 0 }, { speed = c.speed, most_force = 30 })
      robot:move_line { -0.02 * ux, -0.02 * uy, 0.07 }
    end
    robot:open_hand()
  end,
}
