-- A cabinet whose door swings far: the hand that holds its bar may not turn about it.
local doors = require "worlds.lib.doors"

local depth, width, height, wall = 0.18, 0.26, 0.24, 0.012 -- m
local door = doors.door {
  at = { -depth / 2 - 0.001, -width / 2, 0 }, width = width, height = height, colour = { 0.45, 0.52, 0.60 }, most = 150,
  open = 125, pull = 135, handle = { z = 0.15, length = 0.12 },
}
door.numbers.pivot = 0
local straight = {} -- and comes straight towards it
for k, grasp in ipairs(door.grasps) do
  if (k - 1) % 10 < 2 then straight[#straight + 1] = grasp end
end
door.grasps = straight

return object {
  type = "furniture", traits = {}, fixed = true, colour = { 0.85, 0.83, 0.78 },
  shapes = {
    box { wall, width, height, at = { depth / 2 - wall / 2, 0, height / 2 } },
    box { depth, wall, height, at = { 0, width / 2 - wall / 2, height / 2 } },
    box { depth, wall, height, at = { 0, -width / 2 + wall / 2, height / 2 } },
    box { depth, width, wall, at = { 0, 0, wall / 2 } },
    box { depth, width, wall, at = { 0, 0, height - wall / 2 } },
  },
  parts = { door = door },
}
