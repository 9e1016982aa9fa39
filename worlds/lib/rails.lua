-- Rods on a post to hang clothes on; the rod points along +x, `z` m above the table, `length` m long; its end is a knob.
local steel = { 0.55, 0.57, 0.60 }

return function(z, length)
  return object {
    type = "stand", traits = {}, fixed = true, colour = steel, friction = 0.4,
    shapes = {
      box { length + 0.06, 0.12, 0.014, at = { length / 2 - 0.02, 0, 0.007 }, colour = { 0.30, 0.22, 0.16 } },
      cylinder { 0.011, z, at = { 0, 0, z / 2 } },
      cylinder { 0.007, length, at = { length / 2, 0, z }, rpy = { 0, math.pi / 2, 0 } },
      sphere { 0.009, at = { length, 0, z } },
    },
    regions = { -- where the bend of a hanger's hook is for as long as the rod is in it; lifted by 2 to 9 mm it clears the knob
      rod = {
        at = { length / 2 + 0.01, 0, z }, rpy = { 0, math.pi / 2, 0 }, size = { 0.024, 0.024, length - 0.02 },
        traits = { "hook" }, numbers = { lift = 0.0055, deep = length - 0.032, askew = deg(30) },
      },
    },
  }
end
