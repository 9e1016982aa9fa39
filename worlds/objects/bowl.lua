-- A soup bowl with upright walls, 10 cm across and 3.6 cm high; its frame is 1.8 cm above the middle of its foot.
local low, high, foot, rim, wall = -0.018, 0.018, 0.038, 0.050, 0.004 -- m

local grasps = {} -- the rim between the fingers, one of them inside
for k = 0, 11 do
  local angle = k * math.rad(30)
  for _, turn in ipairs { -math.pi / 2, math.pi / 2 } do
    grasps[#grasps + 1] = {
      at = { (rim - wall / 2) * math.cos(angle), (rim - wall / 2) * math.sin(angle), high - 0.011 },
      rpy = { math.pi, 0, angle + turn }, width = wall + 0.001, approach = 0.09, force = 30,
    }
  end
end

return object {
  type = "plate", traits = { "movable", "graspable" }, mass = 0.16, friction = 0.8, colour = { 0.95, 0.95, 0.92 },
  shapes = {
    lathe { { foot, low + 0.004 }, { rim, low + 0.011 }, { rim, high }, wall = wall, segments = 16 },
    cylinder { foot, 0.006, at = { 0, 0, low + 0.003 } },
  },
  visual = {
    lathe { { foot, low + 0.003 }, { rim, low + 0.011 }, { rim, high }, wall = wall, segments = 40 },
    cylinder { foot, 0.006, at = { 0, 0, low + 0.003 } },
    lathe { { rim + 0.0003, high - 0.006 }, { rim + 0.0003, high - 0.002 }, wall = 0.001, segments = 40, colour = { 0.15, 0.30, 0.60 } },
  },
  grasps = grasps,
}
