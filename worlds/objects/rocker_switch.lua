-- A rocker switch on a low box; one end stands up and flips over when it is pressed down.
local dark, tilt = { 0.20, 0.20, 0.22 }, math.rad(14)

return object {
  type = "fixture", traits = {}, fixed = true, colour = dark,
  shapes = { box { 0.11, 0.07, 0.020, at = { 0, 0, 0.010 } }, box { 0.09, 0.05, 0.006, at = { 0, 0, 0.023 }, colour = { 0.75, 0.75, 0.77 } } },
  parts = {
    rocker = {
      type = "switch", traits = { "pressable" }, mass = 0.03, colour = { 0.92, 0.92, 0.90 }, friction = 0.5,
      hinge = { axis = { 0, 1, 0 }, at = { 0, 0, 0.036 }, rpy = { 0, -tilt, 0 }, range = { 0, 2 * tilt }, detent = 0.06,
        friction = 0.005, damping = 0.004 },
      shapes = {
        box { 0.060, 0.028, 0.008 },
        box { 0.010, 0.020, 0.001, at = { 0.022, 0, 0.0043 }, colour = { 0.80, 0.12, 0.10 }, collides = false },
      },
      regions = { spot = { at = { 0.023, 0, 0.004 }, size = { 0.012, 0.02, 0.001 } } },
      numbers = { on_at = 1.92 * tilt, travel = 0.014 },
    },
  },
}
