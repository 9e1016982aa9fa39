-- A square stick, 26 cm long, to reach things with: taken near its one end, it works with the other, +x. Its frame
-- is in its middle.
local long, thick, bound = 0.26, 0.020, 0.06 -- m

local grasps = {} -- across it, from above, where it is bound
for _, x in ipairs { -0.105, -0.095, -0.085 } do
  for _, yaw in ipairs { 0, math.pi } do
    grasps[#grasps + 1] = { at = { x, 0, 0.004 }, rpy = { math.pi, 0, yaw }, width = thick, approach = 0.08, force = 30 }
  end
end

return object {
  type = "stick", traits = { "movable", "graspable", "tool" }, mass = 0.05, friction = 0.6, colour = { 0.80, 0.66, 0.42 },
  shapes = {
    box { long, thick, thick },
    box { bound, thick + 0.001, thick + 0.001, at = { bound / 2 - long / 2 + 0.005, 0, 0 },
      colour = { 0.35, 0.20, 0.14 }, collides = false },
  },
  tip = { at = { long / 2, 0, 0 }, rpy = { 0, math.pi / 2, 0 } },
  numbers = { grip = -0.095 },
  grasps = grasps,
}
