-- A flat plate, 17 cm across, its face towards +z; it is taken by its rim, and a cup stands in its middle.
local radius = 0.085

-- The hand comes from outside towards the middle, one finger on either side.
local grasps = {}
for angle = -45, 45, 5 do
  for _, face in ipairs { 1, -1 } do
    local turn = deg(angle)
    local deep = radius - 0.020 + 0.001 * (angle // 5 % 3 - 1) -- a millimetre more or less
    grasps[#grasps + 1] = {
      at = { deep * math.cos(turn), deep * math.sin(turn), 0 },
      rpy = { face * math.pi / 2, 0, turn - face * math.pi / 2 }, width = 0.012, approach = 0.08, force = 30,
    }
  end
end

return object {
  type = "plate", traits = { "movable", "graspable", "flat", "support", "stackable" }, mass = 0.25,
  shape = cylinder { radius, 0.012 },
  visual = {
    lathe { { 0.001, -0.006 }, { 0.050, -0.006 }, { 0.060, -0.003 }, { radius, 0.003 }, { radius, 0.006 }, { 0.058, 0.0055 },
      { 0.052, 0.0045 }, { 0.001, 0.0045 }, colour = { 0.96, 0.96, 0.94 }, segments = 32 },
    lathe { { 0.072, 0.0058 }, { 0.080, 0.0064 }, wall = 0.001, colour = { 0.15, 0.30, 0.65 }, segments = 32 }, -- a blue ring
  },
  regions = { seat = { at = { -radius, 0, 0 }, rpy = { 0, math.pi / 2, 0 }, size = { 0.002, 0.002, 0.002 } } },
  grasps = grasps,
}
