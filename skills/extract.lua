-- Grasp an object that sits in a slot, socket, port or tube and pull it straight out.
local seats = require "worlds.lib.seats"

return skill {
  params = { "obj: movable & graspable", "slot: slot" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.in_slot("obj", "slot"), is_not.blocked("slot") },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.in_slot("obj", "slot"), is.lifted("obj") },
  continuous = {
    grasp = stream("grasps"),                                           -- of the object where it sits
    clear = { 0.04, min = 0.01, max = 0.15, unit = "m" },               -- how far beyond the slot
    speed = { 0.15, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "pull the {obj} out of the {slot}",
  verbs = { "pull", "take", "remove", "lift" },
  run = function(robot, p, c)
    local w = robot:view()
    local out = seats.way_out(w, p.slot, seats.seat(w, p.obj), c.clear)
    robot:open_hand(c.grasp.opening)
    robot:move_through {
      approach = c.grasp.approach, grasp = c.grasp.pose, ahead = c.grasp.pose:offset(out[1], out[2], out[3]),
    }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:move_line(out, { speed = c.speed, keep_clear = true })           -- of all but what it sits in
  end,
}
