-- A folding umbrella, closed, 25 cm long; it stands on its end, the handle is on top.
local grasps = {}
for i = 0, 7 do
  for _, lean in ipairs { 0, 0.35 } do
    local yaw = i * math.pi / 4
    grasps[#grasps + 1] = { at = { 0, 0, 0.226 }, rpy = { math.pi, -lean, yaw }, width = 0.030, approach = 0.08, force = 45 }
  end
end

-- The cloth, rolled up: radius and height, from its tip to where it is tied, and the edges of its folds.
local tip, tied = { 0.013, 0.015 }, { 0.027, 0.130 }
local shapes = {
  cylinder { 0.013, 0.015, at = { 0, 0, 0.0075 }, colour = { 0.10, 0.10, 0.11 } },                 -- end
  lathe { tip, tied, { 0.012, 0.158 } },
  lathe { { 0.0252, 0.106 }, { 0.0275, 0.121 }, wall = 0.003, colour = { 0.95, 0.85, 0.30 }, collides = false }, -- strap
  cylinder { 0.010, 0.02, at = { 0, 0, 0.165 }, colour = { 0.75, 0.76, 0.78 } },                   -- shaft
  cylinder { 0.015, 0.07, at = { 0, 0, 0.210 }, colour = { 0.50, 0.30, 0.14 } },                   -- handle
  sphere { 0.0155, at = { 0, 0, 0.240 }, colour = { 0.50, 0.30, 0.14 } },
}
for k = 0, 7 do
  local angle, out = k * math.pi / 4, (tip[1] + tied[1]) / 2 - 0.0005
  shapes[#shapes + 1] = box { 0.004, 0.004, 0.112, at = { out * math.cos(angle), out * math.sin(angle), (tip[2] + tied[2]) / 2 },
    rpy = { 0, math.atan(tied[1] - tip[1], tied[2] - tip[2]), angle }, colour = { 0.52, 0.05, 0.12 }, collides = false }
end

return object {
  type = "umbrella", traits = { "movable", "graspable" }, mass = 0.25, colour = { 0.80, 0.12, 0.20 }, friction = 0.7,
  shapes = shapes,
  regions = { seat = { size = { 0.026, 0.026, 0.002 } } },
  grasps = grasps,
}
