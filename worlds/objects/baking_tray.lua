-- A small baking tray, 20 cm by 15 cm, with a knob at either short end to carry it by; its frame is in its middle.
local length, width, rim, wall = 0.15, 0.19, 0.018, 0.004 -- m; length: between the knobs
local ground = -0.012

local grasps = {} -- a knob between the fingers, by a hand that comes forwards and down
for _, down in ipairs { 30, 38, 46 } do
  for _, side in ipairs { 1, -1 } do
    for _, yaw in ipairs { 0, math.pi } do
      local x = -(length / 2 + 0.016) * math.cos(yaw)
      grasps[#grasps + 1] = { at = { x, 0, ground + 0.020 }, width = 0.022, approach = 0.07, force = 60,
        rpy = { math.pi, -side * (math.pi / 2 - math.rad(down)), side > 0 and yaw or yaw + math.pi } }
    end
  end
end

local shapes = {
  box { length, width, wall, at = { 0, 0, ground + wall / 2 } },
  box { wall, width, rim, at = { length / 2 - wall / 2, 0, ground + rim / 2 } },
  box { wall, width, rim, at = { wall / 2 - length / 2, 0, ground + rim / 2 } },
  box { length, wall, rim, at = { 0, width / 2 - wall / 2, ground + rim / 2 } },
  box { length, wall, rim, at = { 0, wall / 2 - width / 2, ground + rim / 2 } },
}
for _, end_of in ipairs { 1, -1 } do
  shapes[#shapes + 1] = box { 0.032, 0.022, 0.024, at = { end_of * (length / 2 + 0.016), 0, ground + 0.018 }, colour = { 0.30, 0.20, 0.14 } }
end

return object {
  type = "tray", traits = { "movable", "graspable" }, mass = 0.22, friction = 0.6, colour = { 0.45, 0.46, 0.48 }, shapes = shapes,
  grasps = grasps,
}
