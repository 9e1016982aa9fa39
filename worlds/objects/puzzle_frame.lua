-- A wooden puzzle, all of whose pieces but one are glued in: a board with a hole 1.5 mm wider all round than that piece.
local cutouts = require "worlds.lib.cutouts"

local half, floor, thick = 0.075, 0.005, 0.008 -- m
local wood = { 0.72, 0.52, 0.30 }
local hole = cutouts.wider(require "worlds.lib.puzzle_outline", 0.0015)
local shapes = cutouts.board(hole, 0, 0, half, half, floor, floor + thick, { 0.35, 0.62, 0.80 })
shapes[#shapes + 1] = box { 2 * half, 2 * half, floor, at = { 0, 0, floor / 2 }, colour = wood }
for _, side in ipairs { 1, -1 } do
  shapes[#shapes + 1] = box { 2 * half + 0.02, 0.01, floor + thick, at = { 0, side * (half + 0.005), (floor + thick) / 2 }, colour = wood }
  shapes[#shapes + 1] = box { 0.01, 2 * half, floor + thick, at = { side * (half + 0.005), 0, (floor + thick) / 2 }, colour = wood }
end
for _, line in ipairs { -0.048, 0.048 } do -- the edges of the pieces that are in
  local z = floor + thick
  shapes[#shapes + 1] = box { 2 * half, 0.001, 0.0004, at = { 0, line, z }, colour = { 0.15, 0.30, 0.42 }, collides = false }
  shapes[#shapes + 1] = box { 0.001, 2 * half, 0.0004, at = { line, 0, z }, colour = { 0.15, 0.30, 0.42 }, collides = false }
end

return object {
  type = "puzzle", traits = { "movable" }, mass = 1.2, friction = 0.6, colour = wood, shapes = shapes,
  regions = { -- from 5 mm under the floor of the hole to 3 mm above it: a piece that lies askew is not in it
    hole = { at = { 0, 0, floor - 0.001 }, size = { 0.008, 0.008, 0.008 }, traits = { "slot" }, numbers = { gap = 0.006, deep = 0.0075, askew = deg(3) } },
  },
  numbers = { room = 0.14 },
}
