-- Grasp a knob, a wheel or the head of a tap and turn it about its axis; beyond the wrist's range grip it again.
local grips = require "worlds.lib.grips"

return skill {
  params = { "part: turnable" },
  precondition = { is.hand_empty(), is_not.turned("part") },
  effect = { is.turned("part") },
  continuous = {
    grasp = stream("grasps", "part", "turn_to"),                        -- from which the wrist can turn far enough
    speed = { 0.08, min = 0.02, max = 0.2, unit = "m/s" },
  },
  label = "turn the {part}",
  verbs = { "turn", "unscrew" },
  run = function(robot, p, c)
    local w = robot:view()
    local goal, wanted = w:number(p.part, "turn_to"), w:number(p.part, "turned_at")
    local o = { speed = c.speed, most_force = 30, away = 0.10 }
    local function turn(grasp) grips.take(robot, p.part, grasp, goal, o) end
    turn(c.grasp)
    grips.go_on(robot, p.part, goal, o, function() return w:joint(p.part) >= wanted end, turn)
  end,
}
