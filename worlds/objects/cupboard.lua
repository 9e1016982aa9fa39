-- A small cupboard without doors, open towards -x: a shelf 0.95 m above the floor, where its frame is, and a lower part
-- that is shut.
local places = require "worlds.lib.places"
local width, depth, height = 0.42, 0.24, 0.42 -- m, inside
local wood, dark = { 0.80, 0.72, 0.58 }, { 0.60, 0.50, 0.38 }

return object {
  type = "furniture", traits = {}, fixed = true, colour = wood,
  place = places.beside_the_table { gap = 0.195, turn = deg(45), above = 0.2, wide = 0.44 },
  nouns = "pantry",
  shapes = {
    box { depth + 0.012, width + 0.03, 0.95, at = { 0.006, 0, -0.475 }, colour = dark },
    box { depth + 0.012, 0.015, height, at = { 0.006, width / 2 + 0.0075, height / 2 } },
    box { depth + 0.012, 0.015, height, at = { 0.006, -width / 2 - 0.0075, height / 2 } },
    box { 0.012, width, height, at = { depth / 2 + 0.006, 0, height / 2 } },
    box { depth + 0.032, width + 0.05, 0.020, at = { 0.006, 0, height + 0.010 } },
  },
  parts = {
    shelf = {
      type = "level", traits = { "container", "shelf" }, fixed = true, mass = 1, colour = { 0.88, 0.82, 0.70 }, friction = 0.6,
      shapes = { box { depth, width, 0.014, at = { 0, 0, 0.007 } } },
      regions = { inside = { at = { 0, 0, 0.014 + (height - 0.014) / 2 }, size = { depth, width, height - 0.014 } } },
    },
  },
}
