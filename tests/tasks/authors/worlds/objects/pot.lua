-- A narrow pot that something may stand in; a hand takes it across its rim.
local radius, height, wall = 0.022, 0.075, 0.004 -- m
local grasps = {}
for k = 0, 11 do
  grasps[#grasps + 1] = {
    at = { 0, 0, height - 0.018 }, rpy = { math.pi, 0, k * math.rad(30) }, width = 2 * radius, approach = 0.09, force = 20,
  }
end

return object {
  type = "cup", traits = { "movable", "graspable" }, mass = 0.20, friction = 0.7, colour = { 0.30, 0.45, 0.60 }, grasps = grasps,
  shapes = { lathe { { radius, 0 }, { radius, height }, wall = wall }, cylinder { radius - 0.001, 0.006, at = { 0, 0, 0.003 } } },
  regions = { hollow = { at = { 0, 0, 0.04 }, size = { 0.04, 0.04, 0.08 }, traits = { "slot" }, numbers = { gap = 0.007 } } },
}
