-- Pull a drawer or door open by its handle; where a lever holds it shut, turn that first. Where the arm cannot follow the
-- whole way with one grip, it takes another.
local grips = require "worlds.lib.grips"

-- The part that the door's attribute `lever` names.
local function lever_of(w, part)
  local name = w:attribute(part, "lever")
  return name and string.sub(part, 1, string.find(part, ".")) .. name
end

return skill {
  params = { "part: openable" },
  precondition = { is.hand_empty(), is_not.open("part"), is_not.blocked("part") },
  effect = { is.open("part"), is_not.closed("part") },
  continuous = {
    grasp = stream("grasps", "part", "pull"),                           -- of the handle, from which it can be pulled
    speed = { 0.12, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "open the {part}",
  verbs = { "open", "lift", "lower", "pull", "slide", "swing" },
  run = function(robot, p, c)
    local w = robot:view()
    robot:open_hand(0.05)
    local pull, pivot = w:number(p.part, "pull"), w:number(p.part, "pivot")
    local o = { speed = c.speed, most_force = 40, pivot = pivot, away = 0.08, opening = 0.05 }
    local lever = lever_of(w, p.part)
    local first, to = lever or p.part, lever and w:number(lever, "turn_to") or c.grasp.reach or pull
    robot:move_through({ approach = c.grasp.approach, grasp = c.grasp.pose },
      { then_part = first, to = to, pivot = lever and 0 or pivot, opening = c.grasp.width, retreat = o.away })
    robot:close_hand(first, { force = c.grasp.force })
    if lever then robot:move_part(lever, to, { speed = c.speed, most_force = 30 }) end
    robot:move_part(p.part, pull,
      { speed = c.speed, most_force = 40, pivot = pivot, retreat = o.away, as_far_as_it_goes = true })
    robot:open_hand(o.opening)
    robot:retreat(o.away, { as_far_as_it_goes = true })
    grips.go_on(robot, p.part, pull, o, function() return w:joint(p.part) >= w:number(p.part, "open_at") end,
      function(grasp) grips.take(robot, p.part, grasp, pull, o) end)
  end,
}
