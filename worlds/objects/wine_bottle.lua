-- A small bottle of wine, 5.6 cm across and 24 cm high, that stands on its foot; its frame is there.
local grasps = {}
for k = 0, 11 do -- from the side, level or a little from above, around the upper part of the body
  for _, down in ipairs { 0, 20 } do
    for _, side in ipairs { 1, -1 } do
      local yaw = k * math.pi / 6
      grasps[#grasps + 1] = {
        at = { 0, 0, 0.140 }, rpy = { math.pi, -side * (math.pi / 2 - deg(down)), side > 0 and yaw or yaw + math.pi },
        width = 0.056, approach = 0.09, force = 50,
      }
    end
  end
end

local glass, foil = { 0.10, 0.22, 0.12 }, { 0.50, 0.08, 0.14 }
return object {
  type = "bottle", traits = { "movable", "graspable" }, mass = 0.40, friction = 0.6, colour = glass,
  shapes = {
    lathe { { 0.026, 0 }, { 0.028, 0.004 }, { 0.028, 0.155 }, { 0.024, 0.168 }, { 0.014, 0.180 } },
    cylinder { 0.013, 0.060, at = { 0, 0, 0.208 } },
    cylinder { 0.0145, 0.036, at = { 0, 0, 0.222 }, colour = foil },
    lathe { { 0.0283, 0.035 }, { 0.0283, 0.105 }, wall = 0.002, colour = { 0.93, 0.90, 0.80 }, collides = false }, -- label
  },
  regions = { seat = { size = { 0.002, 0.002, 0.002 } } },
  numbers = { turns = 12 },
  grasps = grasps,
}
