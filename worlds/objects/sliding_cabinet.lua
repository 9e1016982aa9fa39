-- A low cabinet with two doors that slide apart, each past its side; it opens towards -x. Its frame is below it, 0.75 m above
-- the floor.
local doors, places = require "worlds.lib.doors", require "worlds.lib.places"
local wood, dark, glass = { 0.72, 0.56, 0.38 }, { 0.40, 0.28, 0.18 }, { 0.62, 0.75, 0.80 }
local depth, width, height, wall = 0.22, 0.64, 0.33, 0.012 -- m

-- `side` 1: the left one, seen from the front, which slides to +y.
local function door(side)
  local half, bar_x, bar_y = width / 2 - 0.004, -0.050, -side * (width / 4 - 0.035)
  local shapes = {
    box { 0.012, half, height - 0.03, at = { -0.006, 0, 0 } },
    box { 0.001, half - 0.05, height - 0.09, at = { -0.0125, 0, 0 }, colour = glass, collides = false },
    cylinder { 0.006, 0.10, at = { bar_x, bar_y, 0 }, colour = { 0.25, 0.25, 0.27 } },
  }
  for _, z in ipairs { -0.042, 0.042 } do
    shapes[#shapes + 1] = box { 0.040, 0.008, 0.008, at = { bar_x / 2 - 0.006, bar_y, z }, colour = { 0.25, 0.25, 0.27 } }
  end
  return {
    type = "door", traits = { "openable" }, mass = 0.8, colour = dark, shapes = shapes,
    slider = { axis = { 0, side, 0 }, at = { -depth / 2 - 0.002, side * width / 4, height / 2 }, range = { 0, 0.29 },
      friction = 2, damping = 5 },
    grasps = doors.grasps(bar_x, bar_y, 0, 0.012),
    numbers = { open_at = 0.24, closed_at = 0.004, pull = 0.27, gripped = 1 }, -- nothing to push against: its bar is taken
  }
end

local function shelf(side)
  local half = width / 2 - 1.5 * wall
  return {
    type = "level", traits = { "container", "shelf" }, fixed = { at = { 0, side * (width / 4 - wall / 4), wall } },
    mass = 1, colour = wood, friction = 0.6,
    shapes = { box { depth - 2 * wall, half, 0.004, at = { 0, 0, 0.002 } } },
    regions = { inside = { at = { 0, 0, height / 2 - wall }, size = { depth - 2 * wall, half, height - 2 * wall - 0.008 } } },
  }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = wood,
  place = places.round_the_table { gap = 0.13, turn = deg(16) },
  shapes = {
    box { depth, width, 0.75, at = { 0, 0, -0.375 }, colour = dark }, -- what it stands on
    box { depth, width, wall, at = { 0, 0, wall / 2 } },
    box { depth, width, wall, at = { 0, 0, height - wall / 2 } },
    box { wall, width, height, at = { depth / 2 - wall / 2, 0, height / 2 } },
    box { depth, wall, height, at = { 0, width / 2 - wall / 2, height / 2 } },
    box { depth, wall, height, at = { 0, -width / 2 + wall / 2, height / 2 } },
    box { depth, wall, height, at = { 0, 0, height / 2 } }, -- between the halves
  },
  parts = { left_door = door(1), right_door = door(-1), left_shelf = shelf(1), right_shelf = shelf(-1) },
}
