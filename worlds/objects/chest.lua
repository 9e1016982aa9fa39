-- A cabinet with three drawers that open towards -x; its frame is below the drawers, 0.75 m above the floor.
-- A grasp of the handle by a hand that comes forwards and down at an angle; level hands do not reach all heights.
-- `side` 1 or -1: which finger is on which side of the handle.
local places = require "worlds.lib.places"
local function from_above(degrees, side)
  local pitch = math.pi / 2 - math.rad(degrees)
  return {
    at = { -0.145, 0, 0 }, rpy = { math.pi, side * pitch, side > 0 and math.pi or 0 },
    width = 0.012, approach = 0.07, force = 30,
  }
end

local function drawer(z)
  return {
    type = "drawer", traits = { "openable", "container", "reach_in" },
    slider = { axis = { -1, 0, 0 }, at = { 0, 0, z }, range = { 0, 0.20 }, damping = 5, friction = 2 },
    mass = 0.6, colour = { 0.80, 0.68, 0.50 },
    numbers = { open_at = 0.15, closed_at = 0.004, pull = 0.18, hand_back = -0.02, hand_side = 0.045,
      hand_front = -0.065, hand_turn = 0.05 },
    shapes = {
      box { 0.012, 0.236, 0.076, at = { -0.106, 0, 0 } }, -- front
      box { 0.20, 0.22, 0.006, at = { 0, 0, -0.032 } }, -- floor
      box { 0.20, 0.008, 0.05, at = { 0, 0.107, -0.008 } },
      box { 0.20, 0.008, 0.05, at = { 0, -0.107, -0.008 } },
      box { 0.008, 0.22, 0.05, at = { 0.096, 0, -0.008 } },
      cylinder { 0.006, 0.05, at = { -0.145, 0, 0 }, colour = { 0.2, 0.2, 0.22 } }, -- an upright handle on two posts
      box { 0.036, 0.008, 0.008, at = { -0.128, 0, 0.02 }, colour = { 0.2, 0.2, 0.22 } },
      box { 0.036, 0.008, 0.008, at = { -0.128, 0, -0.02 }, colour = { 0.2, 0.2, 0.22 } },
    },
    grasps = { from_above(40, 1), from_above(40, -1), from_above(55, 1), from_above(55, -1) },
    regions = { inside = { at = { 0, 0, 0.003 }, size = { 0.19, 0.20, 0.064 } } },
  }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = { 0.66, 0.50, 0.33 },
  place = places.round_the_table { gap = 0.12, turn = deg(22), wide = 0.26 },
  nouns = "dresser",
  shapes = {
    box { 0.22, 0.26, 0.75, at = { 0.01, 0, -0.375 } }, -- what it stands on
    box { 0.22, 0.26, 0.01, at = { 0.01, 0, 0.005 } },
    box { 0.22, 0.26, 0.01, at = { 0.01, 0, 0.275 } },
    box { 0.22, 0.01, 0.28, at = { 0.01, 0.125, 0.14 } },
    box { 0.22, 0.01, 0.28, at = { 0.01, -0.125, 0.14 } },
    box { 0.01, 0.26, 0.28, at = { 0.125, 0, 0.14 } },
  },
  parts = { bottom_drawer = drawer(0.055), middle_drawer = drawer(0.14), top_drawer = drawer(0.225) },
  regions = { -- where drawers come out and hands beside them, at the height of what stands on the table
    front = { at = { -0.27, 0, 0.02 }, size = { 0.27, 0.41, 0.04 }, traits = { "marked" } },
  },
}
