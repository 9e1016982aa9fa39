-- Shut a drawer, door or lid: pushed by its handle with the tips of the closed fingers, or swung by its grip, where it has
-- the number `gripped`. Where the arm cannot follow the whole way at once, it touches or grips it again.
local grips = require "worlds.lib.grips"

-- The position past its stop at which the hand has gone `way` m further.
local function past_stop(w, part, hand, way)
  local ahead = w:part_at(part, w:joint(part) - 0.03):times(w:pose(part):inverse()):times(hand)
  local ax, ay, az = ahead:position()
  local x, y, z = hand:position()
  return -way * 0.03 / math.sqrt((ax - x) ^ 2 + (ay - y) ^ 2 + (az - z) ^ 2)
end

local away = 0.08 -- m that the hand goes back at the end

local function push(robot, part, grasp, c, pivot)
  local before = grasp.pose:along(0, 0, -0.042) -- the closed fingers do not touch the handle yet
  local w = robot:view()
  local past = past_stop(w, part, grasp.pose, 0.03) -- the way to the handle, and what the arm gives way
  local whole = not grasp.reach or grasp.reach <= w:number(part, "closed_at")
  robot:close_hand()
  robot:move_through({ approach = grasp.approach, goal = before, ahead = grasp.pose },
    { then_part = part, to = whole and past or grasp.reach, pivot = pivot, retreat = away })
  robot:move_line(grasp.pose, { speed = 0.05, stop_on_contact = true, tolerate = true })
  local function on(to, speed, then_to)
    robot:move_part(part, to, { speed = speed, most_force = 25, pivot = pivot, retreat = away,
      as_far_as_it_goes = true, then_to = then_to })
  end
  if whole then
    local slow = -past / 2
    on(math.min(slow, w:joint(part)), c.speed, past)
    -- The last 1.5 cm slowly: no blow at the stop. Where the arm could not go that far with it, it is touched again.
    if w:joint(part) < 4 * slow then on(past, math.min(c.speed, 0.03)) end
  else
    on(grasp.reach, c.speed)
  end
  robot:retreat(away, { as_far_as_it_goes = true })
end

return skill {
  params = { "part: openable" },
  precondition = { is.hand_empty(), is_not.closed("part"), is_not.blocked("part") },
  effect = { is.closed("part"), is_not.open("part") },
  continuous = {
    grasp = stream("grasps", "part", "closed_at"),                      -- where to touch or take it
    speed = { 0.10, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "close the {part}",
  verbs = { "close", "lower", "pull", "slide", "swing", "push" },
  run = function(robot, p, c)
    local w = robot:view()
    local pivot, gripped = w:number(p.part, "pivot"), w:number(p.part, "gripped") > 0
    local o = { speed = c.speed, most_force = 30, pivot = pivot, away = away, opening = 0.06 }
    local function shut(grasp)
      -- A centimetre past its stop: it is shut as well where the hand slipped a little.
      if gripped then grips.take(robot, p.part, grasp, past_stop(w, p.part, grasp.pose, 0.01), o)
      else push(robot, p.part, grasp, c, pivot) end
    end
    shut(c.grasp)
    local to = gripped and 0 or w:number(p.part, "closed_at")
    grips.go_on(robot, p.part, to, o, function() return w:joint(p.part) <= w:number(p.part, "closed_at") end, shut)
    if not gripped then robot:open_hand() end
  end,
}
