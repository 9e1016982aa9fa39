-- A cup of earthenware with a handle: 7.2 cm across at the rim, 8.5 cm high; its frame is in the middle of its foot.
local height, rim, foot, wall = 0.085, 0.036, 0.027, 0.004 -- m

local slope = math.atan(rim - 0.033, height - 0.030) -- of the upper wall, outwards

local grasps = {} -- the rim between the fingers, one of them inside, flat on the wall; not where the handle is (-y)
for k = -4, 4 do
  local angle = math.pi / 2 + k * math.rad(30)
  for _, turn in ipairs { -math.pi / 2, math.pi / 2 } do
    grasps[#grasps + 1] = {
      at = { (rim - wall / 2 - 0.0005) * math.cos(angle), (rim - wall / 2 - 0.0005) * math.sin(angle), height - 0.013 },
      rpy = { math.pi + (turn > 0 and slope or -slope), 0, angle + turn }, width = wall + 0.002, approach = 0.09, force = 20,
    }
  end
end

return object {
  type = "cup", traits = { "movable", "graspable" }, colour = "white", mass = 0.15,
  shapes = {
    lathe { { foot, 0.004 }, { 0.033, 0.03 }, { rim, height }, wall = wall, segments = 12 },
    cylinder { foot, 0.006, at = { 0, 0, 0.003 } },
    box { 0.008, 0.018, 0.007, at = { 0, -0.041, 0.068 } },
    box { 0.008, 0.007, 0.045, at = { 0, -0.0535, 0.049 } },
    box { 0.008, 0.020, 0.007, at = { 0, -0.040, 0.030 } },
  },
  grasps = grasps,
}
