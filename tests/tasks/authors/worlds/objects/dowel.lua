-- A round peg, 10 cm high, that stands on its end; a hand takes it by the top.
local grasps = {}
for k = 0, 11 do
  grasps[#grasps + 1] = { at = { 0, 0, 0.036 }, rpy = { math.pi, 0, k * math.rad(30) }, width = 0.024, approach = 0.08, force = 20 }
end

return object {
  type = "peg", traits = { "movable", "graspable" }, mass = 0.05, colour = { 0.80, 0.62, 0.38 }, grasps = grasps,
  shape = cylinder { 0.012, 0.10 },
  regions = { seat = { at = { 0, 0, -0.05 }, size = { 0.02, 0.02, 0.002 } } }, -- the end that goes in
  numbers = { turns = 8 },
}
