-- A cup without a handle, 7.6 cm across at the rim and 9 cm high, that another one like it goes into; its frame is in the
-- middle of its foot. Its floor is thick, so that cups in each other do not jam.
local height, rim, foot, wall, floor = 0.090, 0.038, 0.026, 0.004, 0.041 -- m
local slope = math.atan(rim - foot, height)                              -- of the wall, outwards

local grasps = {} -- the rim between the fingers, one of them inside, flat on the wall
for k = 0, 11 do
  local angle = k * math.pi / 6
  for _, turn in ipairs { -math.pi / 2, math.pi / 2 } do
    grasps[#grasps + 1] = {
      at = { (rim - wall / 2 - 0.0015) * math.cos(angle), (rim - wall / 2 - 0.0015) * math.sin(angle), height - 0.012 },
      rpy = { math.pi + (turn > 0 and slope or -slope), 0, angle + turn }, width = wall + 0.002, approach = 0.09, force = 28,
    }
  end
end

return object {
  type = "cup", traits = { "movable", "graspable", "support", "stackable" }, colour = "red", mass = 0.14, friction = 0.5,
  shapes = {
    lathe { { foot, 0 }, { rim, height }, wall = wall },
    cylinder { foot - 0.001, floor, at = { 0, 0, floor / 2 } },
  },
  regions = { mouth = { at = { 0, 0, floor }, size = { 0.02, 0.02, 0.002 } } }, -- where the foot of another one comes to rest
  grasps = grasps,
}
