-- A small cooker on a cupboard: two hot plates, an oven below, and on its slanted panel a knob for each; the panel looks
-- along -x and up. Its frame is below it, 0.75 m above the floor.
local places = require "worlds.lib.places"
local white, steel, black = { 0.92, 0.92, 0.91 }, { 0.70, 0.72, 0.75 }, { 0.10, 0.10, 0.11 }
local depth, width, height, slant = 0.24, 0.40, 0.10, deg(45) -- m; of the panel, from upright
local front = -depth / 2
local out = { 0, slant - math.pi / 2, 0 } -- z out of the panel

-- A place on the panel: across it, out of it.
local function on_panel(y, away)
  return { front - 0.022 - away * math.cos(slant), y, height - 0.022 + away * math.sin(slant) }
end

local function knob(y, traits, mark)
  return {
    type = "knob", traits = traits, mass = 0.05, colour = black, friction = 0.7,
    hinge = { axis = { 0, 0, -1 }, at = on_panel(y, 0.004), rpy = out, range = { 0, math.rad(120) }, friction = 0.08, damping = 0.01 },
    shapes = {
      cylinder { 0.022, 0.010, at = { 0, 0, 0.005 } },
      box { 0.044, 0.014, 0.024, at = { 0, 0, 0.022 } },
      box { 0.014, 0.003, 0.001, at = { 0.014, 0, 0.0345 }, colour = mark, collides = false },
    },
    grasps = each(range(0, 1), function(k)
      return { at = { 0, 0, 0.024 }, rpy = { math.pi, 0, k * math.pi }, width = 0.014, approach = 0.07, force = 30 }
    end),
    numbers = { turn_to = math.rad(95), turned_at = math.rad(86) },
  }
end

local shapes = {
  box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = white }, -- the oven
  box { 0.004, width - 0.08, 0.30, at = { front - 0.002, 0, -0.28 }, colour = black, collides = false },
  cylinder { 0.008, width - 0.10, at = { front - 0.03, 0, -0.09 }, rpy = { math.pi / 2, 0, 0 }, colour = steel, collides = false },
  box { depth, width, height, at = { 0, 0, height / 2 } },
  hull { { front, width / 2, 0 }, { front, -width / 2, 0 }, { front - 0.044, width / 2, 0 }, { front - 0.044, -width / 2, 0 },
    { front - 0.044, width / 2, height - 0.044 }, { front - 0.044, -width / 2, height - 0.044 },
    { front, width / 2, height }, { front, -width / 2, height } },
}
for _, y in ipairs { 0.10, -0.10 } do
  shapes[#shapes + 1] = cylinder { 0.075, 0.004, at = { 0.01, y, height + 0.002 }, colour = black }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = steel, shapes = shapes,
  place = places.round_the_table { gap = 0.13, turn = deg(45), wide = 0.40 },
  parts = { oven_knob = knob(0, { "turnable" }, { 0.85, 0.10, 0.10 }), left_knob = knob(0.12, {}, white), right_knob = knob(-0.12, {}, white) },
}
