-- A dish rack with three slots for plates that stand on edge: black, red and purple posts.
local wire = { 0.80, 0.81, 0.83 }
local shapes = {
  box { 0.27, 0.012, 0.012, at = { 0, 0.046, 0.014 }, colour = wire }, -- rails: a plate stands on both and does not roll
  box { 0.27, 0.012, 0.012, at = { 0, -0.046, 0.014 }, colour = wire },
}
local regions = {}
for i, name in ipairs { "black", "red", "purple" } do
  local x, colour = (i - 2) * 0.09, colours.rgb(name)
  shapes[#shapes + 1] = box { 0.075, 0.15, 0.008, at = { x, 0, 0.004 }, colour = colour }
  for _, side in ipairs { 1, -1 } do
    for _, y in ipairs { 0.056, -0.056 } do
      shapes[#shapes + 1] = cylinder { 0.004, 0.085, at = { x + side * 0.0125, y, 0.0505 }, colour = colour }
    end
    shapes[#shapes + 1] = box { 0.008, 0.12, 0.008, at = { x + side * 0.0125, 0, 0.089 }, colour = colour, collides = false }
  end
  regions[name .. "_slot"] = { -- from 5 mm under the lowest place of a plate to the ends of the posts
    at = { x, 0, 0.049 }, size = { 0.03, 0.04, 0.088 }, traits = { "slot" }, numbers = { gap = 0.0065 },
    attributes = { colour = name },
  }
end
for _, x in ipairs { -0.045, 0.045 } do
  shapes[#shapes + 1] = box { 0.015, 0.15, 0.006, at = { x, 0, 0.003 }, colour = wire }
end

return object {
  type = "dish_rack", traits = { "movable" }, mass = 1.2, friction = 0.5, colour = wire, shapes = shapes, regions = regions,
}
