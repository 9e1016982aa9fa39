-- A folding umbrella, closed, 25 cm long; it stands on its end, the handle is on top.
local grasps = {}
for i = 0, 7 do
  for _, lean in ipairs { 0, 0.35 } do
    local yaw = i * math.pi / 4
    grasps[#grasps + 1] = { at = { 0, 0, 0.226 }, rpy = { math.pi, -lean, yaw }, width = 0.030, approach = 0.08, force = 45 }
  end
end

return object {
  type = "umbrella", traits = { "movable", "graspable" }, mass = 0.25, colour = { 0.80, 0.12, 0.20 }, friction = 0.7,
  shapes = {
    cylinder { 0.013, 0.015, at = { 0, 0, 0.0075 }, colour = { 0.10, 0.10, 0.11 } },                 -- end
    lathe { { 0.014, 0.015 }, { 0.024, 0.09 }, { 0.026, 0.135 }, { 0.016, 0.155 } },                 -- folded cloth
    lathe { { 0.0265, 0.095 }, { 0.0270, 0.110 }, wall = 0.003, colour = { 0.95, 0.85, 0.30 }, collides = false }, -- strap
    cylinder { 0.010, 0.02, at = { 0, 0, 0.165 }, colour = { 0.75, 0.76, 0.78 } },                   -- shaft
    cylinder { 0.015, 0.07, at = { 0, 0, 0.210 }, colour = { 0.50, 0.30, 0.14 } },                   -- handle
    sphere { 0.0155, at = { 0, 0, 0.240 }, colour = { 0.50, 0.30, 0.14 } },
  },
  regions = { seat = { size = { 0.026, 0.026, 0.002 } } },
  grasps = grasps,
}
