-- Racks of wire with slots between upright posts for plates that stand on edge.
local wire = { 0.80, 0.81, 0.83 }

-- Fields of an object: a row of slots, one for each { name, colour }, along x.
return function(slots)
  local long = 0.09 * #slots
  local shapes = {
    box { long, 0.012, 0.012, at = { 0, 0.046, 0.014 }, colour = wire }, -- rails: a plate stands on both and does not roll
    box { long, 0.012, 0.012, at = { 0, -0.046, 0.014 }, colour = wire },
  }
  local regions = {}
  for i, slot in ipairs(slots) do
    local name, colour_name = slot[1], slot[2]
    local x, colour = (i - (#slots + 1) / 2) * 0.09, colours.rgb(colour_name)
    shapes[#shapes + 1] = box { 0.075, 0.15, 0.008, at = { x, 0, 0.004 }, colour = colour }
    for _, side in ipairs { 1, -1 } do
      for _, y in ipairs { 0.056, -0.056 } do
        shapes[#shapes + 1] = cylinder { 0.004, 0.085, at = { x + side * 0.0125, y, 0.0505 }, colour = colour }
      end
      shapes[#shapes + 1] = box { 0.008, 0.12, 0.008, at = { x + side * 0.0125, 0, 0.089 }, colour = colour, collides = false }
    end
    regions[name] = { -- from 5 mm under the lowest place of a plate to the ends of the posts
      at = { x, 0, 0.049 }, size = { 0.03, 0.04, 0.088 }, traits = { "slot" }, numbers = { gap = 0.0065, deep = 0.010, askew = deg(12) },
      attributes = { colour = colour_name },
    }
  end
  for i = 1, #slots - 1 do
    shapes[#shapes + 1] = box { 0.015, 0.15, 0.006, at = { (i - #slots / 2) * 0.09, 0, 0.003 }, colour = wire }
  end
  return { type = "dish_rack", traits = { "movable" }, mass = 0.4 * #slots, friction = 0.5, colour = wire, shapes = shapes, regions = regions }
end
