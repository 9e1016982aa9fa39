-- A gas barbecue for the table; its lid swings up towards +x. Its frame is below it.
local lids = require "worlds.lib.lids"
local black, red, steel, wood = { 0.12, 0.12, 0.13 }, { 0.60, 0.10, 0.08 }, { 0.70, 0.71, 0.73 }, { 0.55, 0.33, 0.16 }
local length, width, height, hood, wall = 0.24, 0.32, 0.10, 0.085, 0.008 -- m

local shapes = {
  box { length, width, 0.012, at = { 0, 0, 0.026 } },
  box { wall, width, height - 0.02, at = { length / 2 - wall / 2, 0, 0.02 + (height - 0.02) / 2 } },
  box { wall, width, height - 0.02, at = { wall / 2 - length / 2, 0, 0.02 + (height - 0.02) / 2 } },
  box { length, wall, height - 0.02, at = { 0, width / 2 - wall / 2, 0.02 + (height - 0.02) / 2 } },
  box { length, wall, height - 0.02, at = { 0, wall / 2 - width / 2, 0.02 + (height - 0.02) / 2 } },
  box { 0.10, 0.09, 0.012, at = { 0, width / 2 + 0.05, height - 0.006 }, colour = wood }, -- tables at both sides
  box { 0.10, 0.09, 0.012, at = { 0, -width / 2 - 0.05, height - 0.006 }, colour = wood },
}
for i = -8, 8 do
  shapes[#shapes + 1] = box { length - 0.02, 0.005, 0.005, at = { 0, i * 0.0175, height - 0.012 }, colour = steel, collides = false }
end
for _, y in ipairs { -0.09, 0, 0.09 } do
  shapes[#shapes + 1] = cylinder { 0.014, 0.014, at = { -length / 2 - 0.007, y, 0.055 }, rpy = { 0, math.pi / 2, 0 }, colour = steel }
end
for _, corner in ipairs { { 1, 1 }, { 1, -1 }, { -1, 1 }, { -1, -1 } } do
  shapes[#shapes + 1] = cylinder { 0.014, 0.02, at = { corner[1] * 0.09, corner[2] * 0.13, 0.01 } }
end

return object {
  type = "barbecue", traits = {}, fixed = true, colour = black, friction = 0.5, shapes = shapes,
  parts = {
    lid = lids.lid {
      at = { length / 2, 0, height + 0.001 }, front = length, mass = 0.8, open = 50, closed = 2, most = 100, friction = 1.2, colour = red,
      shapes = {
        box { wall, width, 0.05, at = { wall / 2 - length, 0, 0.025 } },
        box { length, wall, 0.05, at = { -length / 2, width / 2 - wall / 2, 0.025 } },
        box { length, wall, 0.05, at = { -length / 2, wall / 2 - width / 2, 0.025 } },
        box { wall, width, 0.05, at = { -wall / 2, 0, 0.025 } },
        box { 0.062, width, wall, at = { 0.022 - length, 0, 0.066 }, rpy = { 0, deg(-35), 0 } }, -- the roof
        box { 0.062, width, wall, at = { -0.022, 0, 0.066 }, rpy = { 0, deg(35), 0 } },
        box { length - 0.09, width, wall, at = { -length / 2, 0, hood } },
        cylinder { 0.020, 0.002, at = { -length / 2, 0, hood + 0.005 }, colour = steel, collides = false },
      },
      grip = { z = 0.022, colour = wood },
    },
  },
}
