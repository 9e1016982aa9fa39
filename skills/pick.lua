-- Grasp a movable object where it rests and lift it clear; what is beside it stays where it is.
local neighbours = require "worlds.lib.neighbours"

return skill {
  params = { "obj: movable & graspable", "from: support" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.on("obj", "from"), is_not(exists("?y: movable", is.on("?y", "obj"))) },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.on("obj", "from"), is.lifted("obj"),
    forall("?s: spot", is_not.inside("obj", "?s")) },
  continuous = {
    grasp = stream("grasps"),                                           -- of the object, reachable and free
    height = { 0.10, min = 0.02, max = 0.30, unit = "m" },
  },
  label = "pick up the {obj}",
  verbs = { "take", "hold", "find", "remove", "lift", "pull", "clear" },
  run = function(robot, p, c)
    local beside = neighbours.of(robot:view(), p.obj)
    robot:open_hand(c.grasp.opening)
    robot:move_through { -- planned, blended: does not stop at the approach
      approach = c.grasp.approach, grasp = c.grasp.pose, ahead = c.grasp.pose:offset(0, 0, c.height),
    }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:lift(c.height) -- world z
    neighbours.stayed(robot, p.obj, beside)
  end,
}
