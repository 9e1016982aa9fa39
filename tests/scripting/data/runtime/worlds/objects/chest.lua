-- A box with one drawer that opens towards -x, and a lid above it that hangs on the drawer's cabinet part.
return object {
  type = "fixture", traits = {}, fixed = true, colour = { 0.5, 0.4, 0.3 },
  shapes = { box { 0.2, 0.2, 0.01, at = { 0, 0, 0.005 } }, cylinder { 0.01, 0.2, at = { 0.1, 0, 0.1 }, colour = "red" } },
  parts = {
    a_knob = {
      parent = "drawer", fixed = { at = { -0.12, 0, 0 } }, shapes = { sphere { 0.01 } }, mass = 0.01,
    },
    drawer = {
      type = "drawer", traits = { "openable", "container" },
      slider = { axis = { -2, 0, 0 }, at = { 0, 0, 0.05 }, range = { 0, 0.2 }, damping = 4, friction = 1 },
      mass = 0.5, numbers = { open_at = 0.15 },
      shapes = { box { 0.18, 0.18, 0.02 } },
      grasps = { { at = { -0.12, 0, 0 }, rpy = { math.pi, 0, 0 }, width = 0.02, force = 25 } },
      regions = { inside = { at = { 0, 0, 0.03 }, size = { 0.16, 0.16, 0.04 } } },
    },
  },
}
