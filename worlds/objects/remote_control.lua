-- A remote control that lies on its back; it sends out of its end at +x. Three buttons, a finger apart, on its top.
local dark, soft = { 0.13, 0.13, 0.15 }, { 0.28, 0.28, 0.31 }
local length, width, height = 0.18, 0.054, 0.022 -- m

local function button(x, colour, sign)
  local shapes = { cylinder { 0.0075, 0.012, at = { 0, 0, 0 } } }
  for _, bar in ipairs(sign) do
    bar.colour, bar.collides = { 0.97, 0.97, 0.97 }, false
    shapes[#shapes + 1] = bar
  end
  return {
    type = "button", traits = { "pressable" }, colour = colour, mass = 0.004,
    slider = { axis = { 0, 0, -1 }, at = { x, 0, height / 2 }, range = { 0, 0.004 }, spring = 1.5, damping = 0.5, friction = 0.1 },
    shapes = shapes, numbers = { on_at = 0.0031, travel = 0.0055 },
  }
end

local function bar(x, y) return box { x, y, 0.0004, at = { 0, 0, 0.0062 } } end

local function across(x, yaw) -- from above, beside the buttons
  return { at = { x, 0, between(-0.002, 0.004) }, rpy = { math.pi, between(-0.12, 0.12), yaw }, width = width }
end

return object {
  type = "remote", traits = { "movable", "graspable", "pointable" }, mass = 0.16, friction = 0.9, colour = dark,
  shapes = {
    box { length - 0.012, width, height }, box { 0.006, width - 0.012, height - 0.006, at = { length / 2 - 0.003, 0, 0 }, colour = { 0.35, 0.05, 0.08 } },
    box { 0.006, width - 0.006, height, at = { -length / 2 + 0.003, 0, 0 } },
    box { length - 0.03, width - 0.012, 0.0004, at = { 0, 0, height / 2 }, colour = soft, collides = false },
  },
  parts = {
    power_button = button(0.060, { 0.80, 0.10, 0.12 }, { bar(0.006, 0.0016) }),
    plus_button = button(0.018, { 0.20, 0.22, 0.26 }, { bar(0.008, 0.0018), bar(0.0018, 0.008) }),
    minus_button = button(-0.024, { 0.20, 0.22, 0.26 }, { bar(0.0018, 0.008) }),
  },
  grasps = { across(-0.062, 0), across(-0.062, math.pi), across(0.039, 0), across(0.039, math.pi), across(-0.003, 0), across(-0.003, math.pi) },
}
