-- A box whose lid has five holes of the outlines of the five solids, 1.5 mm wider all round, each over a well of its own.
local cutouts = require "worlds.lib.cutouts"
local solids = require "worlds.lib.sorter_solids"

local half, wall, floor, under, top = 0.032, 0.004, 0.006, 0.056, 0.066 -- m: half a well, its walls, heights
local wood, pale = { 0.80, 0.62, 0.38 }, { 0.93, 0.85, 0.68 }
local places = { { -1, 0.5 }, { 0, 0.5 }, { 1, 0.5 }, { -0.5, -0.5 }, { 0.5, -0.5 } } -- in wells
local pitch = 2 * half

local length, width = 3 * pitch, 2 * pitch
local shapes, regions = { box { length, width, floor, at = { 0, 0, floor / 2 } } }, {}
for _, side in ipairs { 1, -1 } do
  shapes[#shapes + 1] = box { length + 2 * wall, wall, top, at = { 0, side * (width + wall) / 2, top / 2 } }
  shapes[#shapes + 1] = box { wall, width, top, at = { side * (length + wall) / 2, 0, top / 2 } }
  shapes[#shapes + 1] = box { half, pitch, top, at = { side * (length - half) / 2, -half, top / 2 } } -- beside the two
  shapes[#shapes + 1] = box { wall, pitch, under - floor, at = { side * half, half, (under + floor) / 2 } }
end
shapes[#shapes + 1] = box { length, wall, under - floor, at = { 0, 0, (under + floor) / 2 } }
shapes[#shapes + 1] = box { wall, pitch, under - floor, at = { 0, -half, (under + floor) / 2 } }
for i, name in ipairs(solids.names) do
  local x, y = places[i][1] * pitch, places[i][2] * pitch
  local hole = cutouts.wider(solids.outlines[name], 0.0015)
  for _, shape in ipairs(cutouts.board(hole, x, y, half, half, under, top, pale)) do shapes[#shapes + 1] = shape end
  local lowest, out = floor - 0.005, top - 0.010 -- it falls from where the hand lets go
  regions[name .. "_hole"] = { at = { x, y, (lowest + out) / 2 }, size = { 0.058, 0.058, out - lowest }, traits = { "slot" },
    numbers = { gap = top - 0.016 - lowest, deep = under - solids.height - lowest, askew = deg(20) } }
end

return object {
  type = "sorter", traits = { "movable" }, mass = 1.5, friction = 0.6, colour = wood, shapes = shapes, regions = regions,
  numbers = { room = 0.18 },
}
