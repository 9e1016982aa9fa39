-- A wide bookshelf, open towards -x: a shelf 0.95 m above the floor, where its frame is.
local places = require "worlds.lib.places"
local width, depth, height = 0.60, 0.22, 0.40 -- m, inside
local wood, dark = { 0.58, 0.38, 0.22 }, { 0.45, 0.29, 0.16 }

local shapes = {
  box { 0.012, width, 0.95, at = { depth / 2 + 0.006, 0, -0.475 }, colour = dark },
  box { 0.012, width, height, at = { depth / 2 + 0.006, 0, height / 2 }, colour = dark },
  box { depth, width, 0.020, at = { 0, 0, -0.010 } }, box { depth, width, 0.020, at = { 0, 0, -0.32 } },
  box { depth, width, 0.06, at = { 0, 0, -0.92 } }, box { depth, width, 0.020, at = { 0, 0, -0.62 } },
  box { depth + 0.024, width + 0.03, 0.020, at = { 0.006, 0, height + 0.010 } },
}
for _, side in ipairs { 1, -1 } do
  shapes[#shapes + 1] = box { depth + 0.012, 0.015, height + 0.95, at = { 0.006, side * (width / 2 + 0.0075), (height - 0.95) / 2 } }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = wood, shapes = shapes,
  place = places.beside_the_table { gap = 0.185, turn = deg(28), above = 0.2, far = 0.20, wide = 0.62 },
  nouns = "bookcase",
  parts = {
    shelf = {
      type = "level", traits = { "container", "shelf" }, fixed = true, mass = 1, colour = wood, friction = 0.6,
      shapes = { box { depth, width, 0.014, at = { 0, 0, 0.007 } } },
      regions = { inside = { at = { 0, 0, 0.014 + (height - 0.014) / 2 }, size = { depth, width, height - 0.014 } } },
    },
  },
}
