-- A block with two square holes of 21 mm, 2.5 cm deep. Into one of them the hand may search its way.
local wood, hole, height, wall = { 0.62, 0.45, 0.28 }, 0.021, 0.035, 0.03 -- m

local shapes = { box { 0.22, hole + 2 * wall, 0.01, at = { 0, 0, 0.005 } } }
for _, x in ipairs { -0.055, 0.055 } do
  for _, side in ipairs { -1, 1 } do
    shapes[#shapes + 1] = box { (0.11 - hole) / 2, hole + 2 * wall, height, at = { x + side * (0.11 + hole) / 4, 0, height / 2 } }
    shapes[#shapes + 1] = box { hole, wall, height, at = { x, side * (hole + wall) / 2, height / 2 } }
  end
end
local function slot(x, numbers)
  return { at = { x, 0, 0.021 }, size = { 0.01, 0.01, 0.028 }, traits = { "slot" }, numbers = numbers }
end

return object {
  type = "stand", traits = {}, fixed = true, colour = wood, shapes = shapes,
  regions = { searched = slot(0.055, { search = 0.006 }), plain = slot(-0.055) },
}
