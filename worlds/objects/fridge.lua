-- A small fridge on a cupboard, its freezer on top; both doors open towards -x. Its frame is below it, 0.75 m above the floor.
local doors, places = require "worlds.lib.doors", require "worlds.lib.places"
local body, steel, inner = { 0.90, 0.91, 0.92 }, { 0.72, 0.74, 0.77 }, { 0.96, 0.97, 0.98 }
local depth, width, low, high, wall = 0.24, 0.32, 0.38, 0.16, 0.014 -- m; low, high: of the two compartments

local function compartment(z, height)
  return {
    box { wall, width, height, at = { depth / 2 - wall / 2, 0, z + height / 2 }, colour = inner },
    box { depth, wall, height, at = { 0, width / 2 - wall / 2, z + height / 2 } },
    box { depth, wall, height, at = { 0, -width / 2 + wall / 2, z + height / 2 } },
    box { depth, width, wall, at = { 0, 0, z + wall / 2 } },
  }
end

local shapes = {
  box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = { 0.45, 0.47, 0.50 } }, -- what it stands on
  box { depth, width, wall, at = { 0, 0, low + high + wall / 2 } },
}
for _, shape in ipairs(compartment(0, low)) do shapes[#shapes + 1] = shape end
for _, shape in ipairs(compartment(low, high)) do shapes[#shapes + 1] = shape end

local function door(z, height, handle)
  return doors.door {
    at = { -depth / 2 - 0.001, -width / 2, z }, width = width, height = height - 0.004, thick = 0.03, colour = steel, open = 70, pull = 84,
    mass = 1.5, handle = { z = handle, length = 0.10 },
  }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = body, shapes = shapes,
  place = places.round_the_table { gap = 0.13, turn = deg(25), lean = -0.16, wide = 0.32 },
  nouns = "refrigerator",
  parts = {
    shelf = { -- the floor of the lower compartment
      type = "level", traits = { "container", "shelf" }, fixed = { at = { 0, 0, wall } }, mass = 1, colour = inner, friction = 0.6,
      shapes = { box { depth - 2 * wall, width - 2 * wall, 0.004, at = { 0, 0, 0.002 } } },
      regions = { inside = { at = { 0, 0, low / 2 - wall / 2 }, size = { depth - 2 * wall, width - 2 * wall, low - wall - 0.008 } } },
    },
    door = door(0, low, 0.20), freezer_door = door(low, high + wall, 0.08),
  },
  regions = { front = { at = { -depth / 2 - 0.20, -0.08, 0.10 }, size = { 0.40, 0.70, 0.20 }, traits = { "container" } } }, -- where its doors swing, and behind them
}
