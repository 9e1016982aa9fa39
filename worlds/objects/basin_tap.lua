-- A basin with a spout and two taps, each with a bar to turn it by; a quarter turn opens one.
local chrome, white = { 0.80, 0.82, 0.85 }, { 0.95, 0.95, 0.94 }

local function tap(y, mark)
  return {
    type = "tap", traits = { "turnable" }, mass = 0.15, colour = chrome, friction = 0.7,
    hinge = { axis = { 0, 0, 1 }, at = { 0, y, 0.10 }, range = { 0, math.rad(120) }, friction = 0.12, damping = 0.02 },
    shapes = {
      cylinder { 0.012, 0.03, at = { 0, 0, 0.015 } },
      box { 0.070, 0.016, 0.022, at = { 0, 0, 0.036 } },
      cylinder { 0.006, 0.001, at = { 0, 0, 0.0475 }, colour = mark, collides = false },
    },
    grasps = each(range(0, 1), function(k)
      return { at = { 0, 0, 0.036 }, rpy = { math.pi, 0, k * math.pi }, width = 0.016, approach = 0.07, force = 30 }
    end),
    numbers = { turn_to = math.rad(97), turned_at = math.rad(90) },
  }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = white,
  shapes = {
    box { 0.10, 0.34, 0.030, at = { 0, 0, 0.015 } },
    box { 0.09, 0.30, 0.004, at = { 0, 0, 0.032 }, colour = { 0.86, 0.87, 0.88 }, collides = false },
    cylinder { 0.016, 0.070, at = { 0, 0.11, 0.065 }, colour = chrome }, cylinder { 0.016, 0.070, at = { 0, -0.11, 0.065 }, colour = chrome },
    cylinder { 0.013, 0.110, at = { 0, 0, 0.085 }, colour = chrome },
    capsule { 0.011, 0.08, at = { -0.04, 0, 0.135 }, rpy = { 0, math.pi / 2, 0 }, colour = chrome },
    cylinder { 0.011, 0.020, at = { -0.08, 0, 0.125 }, colour = chrome },
  },
  parts = { left_tap = tap(0.11, { 0.85, 0.10, 0.10 }), right_tap = tap(-0.11, { 0.10, 0.20, 0.85 }) },
}
