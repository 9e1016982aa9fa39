-- A hand wheel on an upright stem: three turns from shut to open, one and a half are asked for.
local red, steel = { 0.75, 0.10, 0.08 }, { 0.55, 0.57, 0.60 }

return object {
  type = "furniture", traits = {}, fixed = true, colour = steel,
  shapes = { cylinder { 0.04, 0.10, at = { 0, 0, 0.05 } } },
  parts = {
    wheel = {
      type = "wheel", traits = { "turnable" }, mass = 0.3, colour = red, friction = 0.7,
      hinge = { axis = { 0, 0, 1 }, at = { 0, 0, 0.12 }, range = { 0, 6 * math.pi }, friction = 0.15, damping = 0.02 },
      shapes = {
        cylinder { 0.010, 0.03, at = { 0, 0, 0 } },
        box { 0.060, 0.020, 0.024, at = { 0, 0, 0.026 } },                  -- two bars crossed, to turn it by
        box { 0.020, 0.060, 0.024, at = { 0, 0, 0.026 } },
      },
      grasps = each(range(0, 3), function(k)
        return { at = { 0, 0, 0.028 }, rpy = { math.pi, 0, k * math.pi / 2 }, width = 0.060, approach = 0.07, force = 40 }
      end),
      numbers = { turn_to = 3 * math.pi, turned_at = 3 * math.pi - 0.15 },
    },
  },
  declares = { types = { wheel = { parent = "fixture" } } },
}
