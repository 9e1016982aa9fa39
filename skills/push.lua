-- Slide an object along the surface into a marked area with the closed fingers.
local strokes = require "worlds.lib.strokes"

local gap = 0.024 -- m from the side of the object back to the tip, before it is touched

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
    local function behind(one, x, y) return x - (one.half + gap) * one.x, y - (one.half + gap) * one.y end
    robot:close_hand()
    strokes.slide(robot, p, 0.012, function(one, x, y, out) return out(behind(one, x, y)) end, function(one, x, y)
      local _, _, turn = robot:tip():rpy()
      local yaw = math.atan(one.y, one.x)
      if math.cos(yaw - turn) < 0 then yaw = yaw + math.pi end          -- front and back of the fingers are alike
      local z = w:bottom(p.obj) + math.max(0.012, math.min(0.02, (w:top(p.obj) - w:bottom(p.obj)) / 2))
      local from_x, from_y = behind(one, x, y)
      local start = pose(from_x, from_y, z, math.pi, 0, yaw)
      robot:move_through { approach = start:offset(0, 0, 0.08), goal = start }
      robot:move_line({ one.x * (one.way + 0.015), one.y * (one.way + 0.015), 0 }, { speed = c.speed, most_force = 30 })
      robot:move_line { -0.02 * one.x, -0.02 * one.y, 0.07 }
    end)
    robot:open_hand()
  end,
}
