-- A jar that stands fast, with a lid on a thread: after 80 degrees it is loose.
local tin = { 0.82, 0.80, 0.74 }
local height, turn = 0.09, math.rad(80) -- m, rad

return object {
  type = "jar", traits = { "support" }, fixed = true, colour = "teal",
  shapes = {
    cylinder { 0.036, height - 0.012, at = { 0, 0, (height - 0.012) / 2 } }, cylinder { 0.028, 0.012, at = { 0, 0, height - 0.006 } },
    cylinder { 0.0363, 0.035, at = { 0, 0, 0.038 }, colour = { 0.96, 0.95, 0.90 }, collides = false }, -- its label
  },
  parts = {
    lid = {
      type = "lid", traits = { "movable", "graspable", "threaded" }, mass = 0.03, colour = tin, friction = 0.8,
      screw = { at = { 0, 0, height + 0.001 }, pitch = mm(8), range = { 0, 2 * turn }, friction = 0.1, lets_go = turn },
      shapes = { cylinder { 0.032, 0.022, at = { 0, 0, 0.011 } },
        cylinder { 0.026, 0.001, at = { 0, 0, 0.0225 }, colour = { 0.70, 0.68, 0.62 }, collides = false },
        box { 0.012, 0.003, 0.001, at = { 0.018, 0, 0.0235 }, colour = { 0.30, 0.28, 0.25 }, collides = false } }, -- shows that it turns
      grasps = each(range(0, 5), function(k)
        return { at = { 0, 0, 0.013 }, rpy = { math.pi, 0, k * math.pi / 3 }, width = 0.064, approach = 0.06, force = 30 }
      end),
      numbers = { turn_to = turn * 1.06 },
    },
  },
}
