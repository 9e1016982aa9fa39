-- Shut a drawer, door or lid: pushed by its handle with the tips of the closed fingers, or swung by its grip, where it has
-- the number `gripped`.
-- The position past its stop at which the hand has gone 3 cm further: the way to the handle, and what the arm gives way.
local function pressed(w, part, hand)
  local ahead = w:part_at(part, w:joint(part) - 0.03):times(w:pose(part):inverse()):times(hand)
  local ax, ay, az = ahead:position()
  local x, y, z = hand:position()
  return -0.03 * 0.03 / math.sqrt((ax - x) ^ 2 + (ay - y) ^ 2 + (az - z) ^ 2)
end

local away = 0.08 -- m that the hand goes back at the end

local function swing(robot, p, c, pivot)
  robot:open_hand(0.06)
  robot:move_through({ approach = c.grasp.approach, grasp = c.grasp.pose },
    { then_part = p.part, to = 0, pivot = pivot, opening = c.grasp.width, retreat = away })
  robot:close_hand(p.part, { force = c.grasp.force })
  robot:move_part(p.part, 0, { speed = c.speed, most_force = 30, pivot = pivot, retreat = away })
  robot:open_hand(0.06)
  robot:retreat(away)
end

local function push(robot, p, c, pivot)
  local before = c.grasp.pose:along(0, 0, -0.042) -- the closed fingers do not touch the handle yet
  local past = pressed(robot:view(), p.part, c.grasp.pose)
  robot:close_hand()
  robot:move_through({ approach = c.grasp.approach, goal = before, ahead = c.grasp.pose },
    { then_part = p.part, to = past, pivot = pivot, retreat = away })
  robot:move_line(c.grasp.pose, { speed = 0.05, stop_on_contact = true, tolerate = true })
  robot:move_part(p.part, 0, { speed = c.speed, most_force = 25, pivot = pivot, retreat = away }) -- but for the gap
  robot:move_part(p.part, past, { speed = math.min(c.speed, 0.05), most_force = 25, pivot = pivot, retreat = away })
  robot:retreat(away)
  robot:open_hand()
end

return skill {
  params = { "part: openable" },
  precondition = { is.hand_empty(), is_not.closed("part") },
  effect = { is.closed("part"), is_not.open("part") },
  continuous = {
    grasp = stream("grasps", "part", "closed_at"),                      -- where to touch or take it
    speed = { 0.10, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "close the {part}",
  run = function(robot, p, c)
    local w = robot:view()
    local way = w:number(p.part, "gripped", 0) > 0 and swing or push
    way(robot, p, c, w:number(p.part, "pivot", 0))
  end,
}
