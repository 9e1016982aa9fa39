-- A kitchen knife with a 12 cm blade that lies flat, face up (+z); the handle is at +x.
-- The hand comes from above, or at up to 6 degrees to it, and closes across the width of the handle.
local grasps = {}
for _, x in ipairs { 0.045, 0.055, 0.065 } do
  for _, yaw in ipairs { 0, math.pi } do
    grasps[#grasps + 1] = { at = { between(x - 0.005, x + 0.005), 0, between(0.001, 0.004) },
      rpy = { math.pi, between(-0.1, 0.1), yaw }, width = 0.024, approach = 0.08, force = 30 }
  end
end

local steel, dark, rivet = { 0.82, 0.84, 0.87 }, { 0.12, 0.10, 0.10 }, { 0.75, 0.75, 0.70 }
local blade = { colour = steel }
for _, p in ipairs { { 0.006, -0.014 }, { 0.006, 0.013 }, { -0.085, -0.014 }, { -0.108, 0.013 }, { -0.116, 0.008 } } do
  blade[#blade + 1] = { p[1], p[2], -0.0015 }
  blade[#blade + 1] = { p[1], p[2], 0.0015 }
end

return object {
  type = "knife", traits = { "movable", "graspable" }, mass = 0.14, friction = 0.5,
  shapes = {
    box { 0.105, 0.024, 0.018, at = { 0.0575, 0, 0 }, colour = dark },
    hull(blade),
    cylinder { 0.004, 0.019, at = { 0.030, 0, 0 }, colour = rivet, collides = false },
    cylinder { 0.004, 0.019, at = { 0.085, 0, 0 }, colour = rivet, collides = false },
  },
  regions = { seat = { at = { -0.116, 0, 0 }, rpy = { 0, math.pi / 2, 0 }, size = { 0.002, 0.002, 0.002 } } },
  numbers = { grip = 0.055 },
  grasps = grasps,
}
