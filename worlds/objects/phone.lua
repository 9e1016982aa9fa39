-- A cordless phone that lies on its back; its earpiece and the stub of its aerial are at +x.
local function from_above(x, yaw) -- or at up to 10 degrees to it, along the phone
  return { at = { between(x - 0.01, x + 0.01), 0, between(0.003, 0.008) },
    rpy = { math.pi, between(-0.17, 0.17), yaw }, width = 0.048 }
end

local dark = { 0.10, 0.10, 0.12 }
local outline = { { -0.075, 0.018 }, { -0.068, 0.024 }, { 0.068, 0.024 }, { 0.075, 0.018 } }
local body = { colour = { 0.14, 0.32, 0.58 } }
for _, p in ipairs(outline) do
  for _, side in ipairs { 1, -1 } do
    body[#body + 1] = { p[1], side * p[2], -0.013 }
    body[#body + 1] = { p[1] * 0.97, side * p[2], 0.013 }
  end
end

local shapes = {
  hull(body),
  cylinder { 0.006, 0.022, at = { 0.083, 0.012, 0 }, rpy = { 0, math.pi / 2, 0 }, colour = dark },
  box { 0.034, 0.036, 0.001, at = { 0.030, 0, 0.0132 }, colour = { 0.55, 0.85, 0.70 }, collides = false }, -- display
  box { 0.004, 0.020, 0.001, at = { 0.060, 0, 0.0132 }, colour = dark, collides = false }, -- earpiece
  box { 0.004, 0.010, 0.001, at = { -0.066, 0, 0.0132 }, colour = dark, collides = false }, -- microphone
}
for row = 0, 3 do
  for column = -1, 1 do
    shapes[#shapes + 1] = box { 0.010, 0.010, 0.002, at = { 0.002 - row * 0.016, column * 0.014, 0.0135 },
      colour = { 0.92, 0.92, 0.90 }, collides = false }
  end
end

return object {
  type = "phone", traits = { "movable", "graspable" }, mass = 0.15, shapes = shapes,
  regions = { seat = { at = { 0, 0, -0.013 }, size = { 0.002, 0.002, 0.002 } } }, -- what its cradle holds
  grasps = {
    from_above(0, 0), from_above(0, math.pi), from_above(-0.02, 0), from_above(-0.02, math.pi), from_above(0.02, 0),
    from_above(0.02, math.pi),
  },
}
