-- A chicken drumstick that lies on its flat side, the bone towards +x; its frame is where a hand takes it.
-- Eight-cornered sections across the leg: x, half the width, height; all begin at the flat side.
local function leg(sections, colour)
  local points = {}
  for _, s in ipairs(sections) do
    local x, w, h = s[1] + 0.018, s[2], s[3]
    for _, p in ipairs { { 0.6, 0 }, { 1, 0.28 }, { 1, 0.72 }, { 0.6, 1 } } do
      points[#points + 1] = { x, w * p[1], h * p[2] - 0.022 }
      points[#points + 1] = { x, -w * p[1], h * p[2] - 0.022 }
    end
  end
  points.colour = colour
  return hull(points)
end

local skin, bone = { 0.86, 0.55, 0.20 }, { 0.95, 0.91, 0.82 }

local function from_above(x, yaw) return { at = { x, 0, 0.002 }, rpy = { math.pi, 0, yaw }, width = 0.056 } end

return object {
  type = "meat", traits = { "movable", "graspable" }, mass = 0.14,
  shapes = {
    leg({ { -0.060, 0.014, 0.034 }, { -0.045, 0.027, 0.043 }, { -0.030, 0.028, 0.044 }, { -0.002, 0.028, 0.044 } }, skin),
    leg({ { -0.002, 0.028, 0.044 }, { 0.040, 0.011, 0.026 } }, skin),
    cylinder { 0.007, 0.035, at = { 0.070, 0, -0.009 }, rpy = { 0, math.pi / 2, 0 }, colour = bone },
    sphere { 0.010, at = { 0.088, 0.006, -0.009 }, colour = bone },
    sphere { 0.010, at = { 0.088, -0.006, -0.009 }, colour = bone },
  },
  grasps = { from_above(0, 0), from_above(0, math.pi), from_above(-0.008, 0), from_above(-0.008, math.pi) },
}
