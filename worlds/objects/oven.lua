-- An oven on a cupboard, with a flap that swings down towards -x and a shelf inside. Its frame is below it, 0.75 m above the floor.
local lids, places = require "worlds.lib.lids", require "worlds.lib.places"
local steel, dark, inner = { 0.74, 0.75, 0.77 }, { 0.12, 0.12, 0.13 }, { 0.28, 0.28, 0.30 }
local depth, width, foot, height, wall = 0.26, 0.38, 0.06, 0.36, 0.014 -- m; foot: up to the shelf

return object {
  type = "furniture", traits = {}, fixed = true, colour = steel,
  place = places.round_the_table { gap = 0.14, turn = deg(45), wide = 0.38 },
  nouns = "cooker stove",
  shapes = {
    box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = { 0.50, 0.40, 0.30 } }, -- what it stands on
    box { depth, width, foot, at = { 0, 0, foot / 2 } },
    box { depth, width, wall, at = { 0, 0, height - wall / 2 } },
    box { wall, width, height, at = { depth / 2 - wall / 2, 0, height / 2 } },
    box { depth, wall, height, at = { 0, width / 2 - wall / 2, height / 2 } },
    box { depth, wall, height, at = { 0, -width / 2 + wall / 2, height / 2 } },
  },
  parts = {
    shelf = {
      type = "level", traits = { "container", "shelf" }, fixed = { at = { 0, 0, foot } }, mass = 1, colour = inner, friction = 0.5,
      shapes = { box { depth - 2 * wall, width - 2 * wall, 0.006, at = { 0, 0, 0.003 } } },
      regions = { inside = { at = { 0, 0, (height - foot) / 2 }, size = { depth - 2 * wall, width - 2 * wall, height - foot - wall - 0.012 } } },
    },
    door = lids.flap {
      at = { -depth / 2 - 0.001, 0, foot }, width = width, height = height - foot - 0.06, colour = dark,
      shapes = { box { 0.001, width - 0.10, height - foot - 0.15, at = { -0.0185, 0, 0.11 }, colour = { 0.30, 0.22, 0.15 }, collides = false } },
    },
    panel = { -- above the flap, flush with the walls: the wrist passes below it
      type = "fixture", fixed = { at = { -depth / 2 + wall / 2, 0, height - wall - 0.022 } }, mass = 1, colour = steel,
      shapes = { box { wall, width - 2 * wall, 0.044 } },
    },
  },
  regions = { -- a baking tray that lies wholly outside is clear of the flap
    front = { at = { -depth / 2 - 0.19, 0, 0.02 }, size = { 0.14, width - 0.02, 0.04 }, traits = { "marked" } },
  },
}
