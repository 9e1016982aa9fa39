-- Hang the held object on a hook or rod: over its end, along it and down.
local seats = require "worlds.lib.seats"

return skill {
  params = { "obj: movable", "hook: hook" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not.hanging("obj", "hook"), is_not(exists("?y: movable", is.hanging("?y", "hook"))) },
  effect = { is.hanging("obj", "hook"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = {
    spot = stream(is.hanging("obj", "hook")),                           -- pose of the object
    clear = { 0.03, min = 0.01, max = 0.15, unit = "m" },               -- how far before the end the straight way begins
    speed = { 0.10, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "hang the {obj} on the {hook}",
  verbs = { "hang", "lower", "put", "drop", "insert", "slide" },
  run = function(robot, p, c)
    local w = robot:view()
    local up = w:number(p.hook, "lift")                           -- what clears the tip of the hook
    local _, _, length = w:size(p.hook)
    local hung = robot:tip_for(p.obj, c.spot)
    local over = hung:offset(0, 0, up)
    local x, y, z = w:position(p.hook)
    local ox, oy, oz = w:pose(p.hook):along(0, 0, length / 2 + c.clear):position()
    local away = 0.03 / (length / 2 + c.clear)                          -- and a little further at first
    local before = over:offset(ox - x, oy - y, oz - z)
    robot:move_through {
      { "approach", before:offset(away * (ox - x), away * (oy - y), away * (oz - z) + 0.03) }, { "goal", before },
      { "ahead", over }, { "ahead", hung }, { "ahead", hung:along(0, 0, -0.10) }, -- and back again
    }
    robot:move_line(over, { speed = c.speed, keep_clear = true })       -- of all but the hook
    robot:move_line(hung, { speed = 0.5 * c.speed, keep_clear = true, tolerate = true })
    robot:wait(0.1)
    robot:open_hand()
    robot:retreat(0.10)
  end,
}
