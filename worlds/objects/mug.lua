-- A coffee mug with straight walls and a large handle: 8 cm across, 9.5 cm high; its frame is in the middle of its foot.
local height, radius, wall = 0.095, 0.040, 0.004 -- m

local grasps = {} -- the rim between the fingers, one of them inside; not where the handle is (-y)
for k = -4, 4 do
  local angle = math.pi / 2 + k * math.rad(30)
  for _, turn in ipairs { -math.pi / 2, math.pi / 2 } do
    grasps[#grasps + 1] = {
      at = { (radius - wall / 2) * math.cos(angle), (radius - wall / 2) * math.sin(angle), height - 0.013 },
      rpy = { math.pi, 0, angle + turn }, width = wall + 0.001, approach = 0.09, force = 20,
    }
  end
end

return object {
  type = "cup", traits = { "movable", "graspable" }, colour = { 0.18, 0.36, 0.52 }, mass = 0.32,
  shapes = {
    lathe { { radius, 0.004 }, { radius, height }, wall = wall },
    cylinder { radius, 0.006, at = { 0, 0, 0.003 } },
    box { 0.010, 0.024, 0.009, at = { 0, -0.051, 0.074 } },
    box { 0.010, 0.009, 0.055, at = { 0, -0.0665, 0.050 } },
    box { 0.010, 0.024, 0.009, at = { 0, -0.051, 0.026 } },
  },
  grasps = grasps,
}
