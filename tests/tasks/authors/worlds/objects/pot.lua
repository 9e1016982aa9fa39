-- A small pot that something may stand in; a hand takes it by its rim.
local radius, height, wall = 0.032, 0.075, 0.004 -- m
local grasps = {}
for k = 0, 11 do
  local angle = k * math.rad(30)
  for _, turn in ipairs { -math.pi / 2, math.pi / 2 } do
    grasps[#grasps + 1] = {
      at = { (radius - wall / 2) * math.cos(angle), (radius - wall / 2) * math.sin(angle), height - 0.012 },
      rpy = { math.pi, 0, angle + turn }, width = wall + 0.001, approach = 0.09, force = 30,
    }
  end
end

return object {
  type = "cup", traits = { "movable", "graspable" }, mass = 0.20, friction = 0.7, colour = { 0.30, 0.45, 0.60 }, grasps = grasps,
  shapes = { lathe { { radius, 0 }, { radius, height }, wall = wall }, cylinder { radius - 0.001, 0.006, at = { 0, 0, 0.003 } } },
  regions = { hollow = { at = { 0, 0, 0.04 }, size = { 0.05, 0.05, 0.08 }, traits = { "slot" }, numbers = { gap = 0.007 } } },
}
