-- A flat wooden ring with a square hole of 5.2 cm and a handle along +x; it goes over a peg in four ways.
local out, hole, high = 0.092, 0.052, 0.020 -- m
local bar, middle = (out - hole) / 2, (out + hole) / 4

local grasps = {} -- the handle between the fingers, from above
for _, x in ipairs { 0.075, 0.083 } do
  for _, yaw in ipairs { 0, math.pi } do
    grasps[#grasps + 1] = { at = { x, 0, 0.004 }, rpy = { math.pi, 0, yaw }, width = 0.018, approach = 0.08, force = 35 }
  end
end

return object {
  type = "ring", traits = { "movable", "graspable" }, mass = 0.08, friction = 0.6, colour = { 0.88, 0.74, 0.48 },
  shapes = {
    box { out, bar, high, at = { 0, middle, 0 } }, box { out, bar, high, at = { 0, -middle, 0 } },
    box { bar, hole, high, at = { middle, 0, 0 } }, box { bar, hole, high, at = { -middle, 0, 0 } },
    box { 0.060, 0.018, high, at = { out / 2 + 0.030, 0, 0 }, colour = { 0.66, 0.46, 0.24 } },
  },
  regions = { loop = { size = { 0.01, 0.01, 0.01 } } },
  numbers = { turns = 4, grip = 0.079 },
  grasps = grasps,
}
