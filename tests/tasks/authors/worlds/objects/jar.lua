-- A jar that stands fast, with a lid on a thread: after 80 degrees it is loose.
local glass, tin = { 0.80, 0.88, 0.86 }, { 0.75, 0.20, 0.15 }
local height, turn = 0.09, math.rad(80) -- m, rad

return object {
  declares = { types = { jar = { parent = "fixture" } } },
  type = "jar", traits = { "support" }, fixed = true, colour = glass,
  shapes = { cylinder { 0.032, height, at = { 0, 0, height / 2 } } },
  parts = {
    lid = {
      type = "lid", traits = { "movable", "graspable", "threaded" }, mass = 0.03, colour = tin, friction = 0.8,
      screw = { at = { 0, 0, height + 0.001 }, pitch = mm(8), range = { 0, 2 * turn }, friction = 0.1, lets_go = turn },
      shapes = { cylinder { 0.030, 0.024, at = { 0, 0, 0.012 } } },
      grasps = each(range(0, 5), function(k)
        return { at = { 0, 0, 0.014 }, rpy = { math.pi, 0, k * math.pi / 3 }, width = 0.060, approach = 0.06, force = 30 }
      end),
      numbers = { turn_to = turn * 1.06 },
    },
  },
}
