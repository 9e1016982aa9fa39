-- A beaker that holds small things; a hand takes it level, from any side.
local radius, height, wall = 0.034, 0.085, 0.003 -- m
local grasps = {}
for _, down in ipairs { deg(15), deg(30) } do
  for k = 0, 11 do
    local yaw = k * deg(30)
    local at = { -0.005 * math.cos(yaw), -0.005 * math.sin(yaw), height - 0.014 }
    for _, over in ipairs { 0, 1 } do -- the hand turned over too
      grasps[#grasps + 1] = { at = at, rpy = { 0, (1 - 2 * over) * (math.pi / 2 + down), yaw + over * math.pi }, width = 2 * radius, approach = 0.09 }
    end
  end
end

return object {
  type = "cup", traits = { "movable", "graspable" }, mass = 0.15, friction = 0.8, colour = { 0.25, 0.45, 0.70 }, grasps = grasps,
  shapes = { lathe { { radius, 0.003 }, { radius, height }, wall = wall }, cylinder { radius, 0.006, at = { 0, 0, 0.003 } } },
  regions = { hold = { at = { 0, 0, 0.042 }, size = { 0.040, 0.040, 0.07 }, traits = { "container" } } },
  numbers = { stands = 1, room = 0.13 },
}
