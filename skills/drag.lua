-- Drag an object along the surface into a marked area with the tip of a tool: its last few centimetres lie flat along a
-- side of the object, so that it does not turn.
local strokes = require "worlds.lib.strokes"

local gap = 0.020    -- m from the side of the object to the middle of the tool, before it is touched
local high = 0.024   -- m above the surface: the middle of the tool
local beyond = 0.015 -- m that the tip reaches beyond the middle of the object's side, and half of that

return skill {
  params = { "tool: tool", "obj: movable", "area: pad", "top: surface" },
  moves = { "obj" },
  precondition = { is.holding("tool"), is.on("obj", "top"), is_not.covers("obj", "area") },
  effect = { is.covers("obj", "area") },
  continuous = { speed = { 0.12, min = 0.02, max = 0.2, unit = "m/s" } },
  label = "drag the {obj} onto the {area} with the {tool}",
  verbs = { "drag", "pull", "slide" },
  run = function(robot, p, c)
    local w, tip = robot:view(), p.tool .. ".tip"
    local tx, ty, tz = w:pose(tip):inverse():times(robot:tip()):position()
    local reach = math.sqrt(tx ^ 2 + ty ^ 2 + tz ^ 2) -- of the tool out of the hand
    -- Where the tip begins, and with `hand` the hand; to which of both sides the tool points is chosen by that one's way.
    local function at(one, x, y, gone, hand)
      local along, off = gone - one.half - gap, one.half + beyond - hand
      return x + along * one.x + off * one.ax, y + along * one.y + off * one.ay
    end
    local function hand_out(one, x, y, out)
      local least
      for _, side in ipairs { 1, -1 } do
        local ax, ay = -one.y * side, one.x * side -- along the tool, out of the hand
        local tried = { x = one.x, y = one.y, half = one.half, ax = ax, ay = ay }
        local worst = math.max(out(at(tried, x, y, 0, reach)), out(at(tried, x, y, one.way, reach)))
        if not least or worst < least then least, one.ax, one.ay = worst, ax, ay end
      end
      return least
    end
    strokes.slide(robot, p, 0.010, hand_out, function(one, x, y)
      local from_x, from_y = at(one, x, y, 0, 0)
      local start = robot:tip_for(tip, pose(from_x, from_y, w:bottom(p.obj) + high, 0, math.pi / 2, math.atan(one.ay, one.ax)))
      local long = one.way + gap - 0.008
      local way = { { by = { long * one.x, long * one.y, 0 }, speed = c.speed, stop = true },
        { by = { -0.02 * one.x, -0.02 * one.y, 0.06 } } }
      robot:move_through({ approach = start:offset(0, 0, 0.06), goal = start }, { then_follow = way })
      robot:follow(way, { most_force = 20 })
    end)
  end,
}
