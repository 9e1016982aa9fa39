-- Grasp an object that hangs on a hook or rod, lift it a little and take it off over the end.
local seats = require "worlds.lib.seats"

return skill {
  params = { "obj: movable & graspable", "hook: hook" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.hanging("obj", "hook") },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.hanging("obj", "hook"), is.lifted("obj") },
  continuous = {
    grasp = stream("grasps"),                                           -- of the object where it hangs
    clear = { 0.02, min = 0.01, max = 0.15, unit = "m" },               -- how far beyond the end of the hook
    speed = { 0.15, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "take the {obj} off the {hook}",
  verbs = { "take", "remove", "lift", "slide" },
  run = function(robot, p, c)
    local w = robot:view()
    local up = w:number(p.hook, "lift")                           -- what frees it
    local off = seats.way_out(w, p.hook, seats.loop(w, p.obj), c.clear)
    robot:open_hand(c.grasp.opening)
    robot:move_through {
      approach = c.grasp.approach, grasp = c.grasp.pose,
      ahead = c.grasp.pose:offset(off[1], off[2], off[3] + up),
    }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:lift(up, { speed = c.speed, keep_clear = true })
    robot:move_line(off, { speed = c.speed, keep_clear = true })
  end,
}
