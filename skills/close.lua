-- Push a drawer or door shut, the tips of the closed fingers against its handle.
-- How far past its stop the part would have to go for the hand to have gone 3 cm: the way to the handle, and what the
-- arm gives way.
local function beyond(w, part, hand)
  local ahead = w:part_at(part, w:joint(part) - 0.03):times(w:pose(part):inverse()):times(hand)
  local ax, ay, az = ahead:position()
  local x, y, z = hand:position()
  return 0.03 * 0.03 / math.sqrt((ax - x) ^ 2 + (ay - y) ^ 2 + (az - z) ^ 2)
end

return skill {
  params = { "part: openable" },
  precondition = { is.hand_empty(), is_not.closed("part") },
  effect = { is.closed("part"), is_not.open("part") },
  continuous = {
    grasp = stream("grasps", "part"),                                   -- where to touch the handle
    speed = { 0.10, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "close the {part}",
  run = function(robot, p, c)
    local reach = 0.042 -- m from the middle of the handle back to the tip: the closed fingers do not touch it yet
    robot:close_hand()
    robot:move_through { approach = c.grasp.approach, goal = c.grasp.pose:along(0, 0, -reach) }
    robot:move_line(c.grasp.pose, { speed = 0.05, stop_on_contact = true, tolerate = true })
    robot:move_part(p.part, 0, { speed = c.speed, most_force = 25 }) -- the last centimetre is left, for the gap
    local past = beyond(robot:view(), p.part, c.grasp.pose)
    robot:move_part(p.part, -past, { speed = math.min(c.speed, 0.05), most_force = 25 }) -- gently against the stop
    robot:retreat(0.08)
    robot:open_hand()
  end,
}
