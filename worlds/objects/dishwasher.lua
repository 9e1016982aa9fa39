-- A small dishwasher on a cupboard: behind its flap, which swings down towards -x, a rack that slides out, with one slot for a
-- plate. Its frame is below it, 0.75 m above the floor.
local lids, racks = require "worlds.lib.lids", require "worlds.lib.dish_racks"
local places = require "worlds.lib.places"
local white, inner, wire = { 0.90, 0.91, 0.92 }, { 0.62, 0.64, 0.67 }, { 0.80, 0.81, 0.83 }
local depth, width, foot, height, wall = 0.27, 0.34, 0.05, 0.36, 0.014 -- m; foot: up to its floor

local rack = racks { { "slot", "blue" } }
for _, side in ipairs { 1, -1 } do
  rack.shapes[#rack.shapes + 1] = box { 0.22, 0.008, 0.010, at = { 0, side * 0.10, 0.005 } }
  rack.shapes[#rack.shapes + 1] = box { 0.008, 0.20, 0.010, at = { side * 0.106, 0, 0.005 } }
end
rack.shapes[#rack.shapes + 1] = box { 0.20, 0.012, 0.006, at = { 0, 0, 0.003 } }
rack.shapes[#rack.shapes + 1] = box { 0.008, 0.010, 0.040, at = { -0.106, 0, 0.020 } }
rack.shapes[#rack.shapes + 1] = cylinder { 0.008, 0.030, at = { -0.106, 0, 0.044 }, rpy = { math.pi / 2, 0, 0 }, colour = { 0.25, 0.35, 0.60 } }

return object {
  type = "furniture", traits = {}, fixed = true, colour = white,
  place = places.round_the_table { gap = 0.15, turn = deg(45), wide = 0.34 },
  shapes = {
    box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = { 0.55, 0.50, 0.45 } }, -- what it stands on
    box { depth, width, foot, at = { 0, 0, foot / 2 } },
    box { depth, width, wall, at = { 0, 0, height - wall / 2 } },
    box { wall, width, height, at = { depth / 2 - wall / 2, 0, height / 2 }, colour = inner },
    box { depth, wall, height, at = { 0, width / 2 - wall / 2, height / 2 } },
    box { depth, wall, height, at = { 0, -width / 2 + wall / 2, height / 2 } },
    box { 0.018, width, 0.05, at = { -depth / 2 - 0.009, 0, height - 0.025 } }, -- above the flap
    box { 0.001, 0.06, 0.015, at = { -depth / 2 - 0.0185, 0.08, height - 0.025 }, colour = { 0.10, 0.25, 0.15 }, collides = false },
  },
  parts = {
    door = lids.flap { at = { -depth / 2 - 0.001, 0, foot }, width = width, height = height - foot - 0.052, colour = white },
    rack = {
      type = "drawer", traits = { "openable" }, mass = 0.6, friction = 0.5, colour = wire,
      slider = { axis = { -1, 0, 0 }, at = { -0.005, 0, foot + 0.020 }, range = { 0, 0.28 }, friction = 2, damping = 5 },
      shapes = rack.shapes, regions = rack.regions, grasps = lids.grasps(-0.106, 0, 0.044, 0.030),
      numbers = { open_at = 0.24, closed_at = 0.004, pull = 0.265 },
    },
  },
}
