-- Kitchen scales: a tray on a spring, and a needle that turns as the tray sinks; the dial looks along -x.
local white, steel, mass, stiffness = { 0.93, 0.92, 0.88 }, { 0.78, 0.79, 0.81 }, 0.25, 300
local shapes = {
  box { 0.16, 0.18, 0.010, at = { 0, 0, 0.005 }, colour = white },
  box { 0.12, 0.14, 0.060, at = { 0.012, 0, 0.040 }, colour = white },
  cylinder { 0.034, 0.004, at = { -0.049, 0, 0.040 }, rpy = { 0, math.pi / 2, 0 }, colour = { 0.98, 0.98, 0.97 }, collides = false },
}
for mark = 0, 9 do -- of the dial
  local angle = mark * math.pi / 5
  shapes[#shapes + 1] = box { 0.001, 0.0015, 0.006, colour = { 0.1, 0.1, 0.1 }, collides = false,
    at = { -0.0515, -0.029 * math.sin(angle), 0.040 + 0.029 * math.cos(angle) }, rpy = { angle, 0, 0 } }
end

return object {
  type = "scales", traits = {}, fixed = true, shapes = shapes,
  parts = {
    tray = {
      type = "tray", traits = { "support", "surface" }, mass = mass, colour = steel, friction = 0.6,
      slider = { axis = { 0, 0, -1 }, at = { 0, 0, 0.085 }, range = { 0, 0.02 }, stiffness = stiffness,
        spring_target = -mass * 9.81 / stiffness, friction = 0.01, damping = 5 }, -- empty, it is at 0
      shapes = {
        box { 0.16, 0.16, 0.006, at = { 0, 0, 0.003 } },
        cylinder { 0.02, 0.016, at = { 0, 0, -0.008 } },
      },
    },
    needle = {
      type = "fixture", mass = 0.001, colour = "red",
      hinge = { axis = { 1, 0, 0 }, at = { -0.052, 0, 0.040 }, range = { 0, 5 }, follows = { part = "tray", ratio = 250 } },
      shapes = { box { 0.001, 0.003, 0.026, at = { 0, 0, 0.012 }, collides = false } },
    },
  },
}
