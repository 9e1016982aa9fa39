-- The five solids of the shape sorter and their outlines: 4.4 cm high, taken by their upper half.
local cutouts = require "worlds.lib.cutouts"
local sorter_solids = { names = { "cube", "cylinder", "prism", "star", "moon" }, height = 0.044 }

local function polar(list)
  local points = {}
  for i, p in ipairs(list) do points[i] = { p[1] * math.cos(p[2]), p[1] * math.sin(p[2]) } end
  return points
end

local round, star, moon, prism = {}, {}, {}, {}
for k = 0, 15 do round[k + 1] = { 0.020, k * math.pi / 8 } end
for k = 0, 4 do
  local angle = k * 2 * math.pi / 5
  for _, p in ipairs { { 0.0125, -math.pi / 5 }, { 0.0245, -0.12 }, { 0.0245, 0.12 } } do star[#star + 1] = { p[1], angle + p[2] } end
end
for k = 0, 2 do
  for _, off in ipairs { -0.115, 0.115 } do prism[#prism + 1] = { 0.0265, k * 2 * math.pi / 3 + off } end
end
for k = 1, 11 do moon[k] = polar { { 0.024, math.pi / 2 + (k - 1) * math.pi / 10 } }[1] end -- the back: half a circle
for _, p in ipairs { { 0.009, -0.022 }, { 0.004, -0.012 }, { 0.002, 0 }, { 0.004, 0.012 }, { 0.009, 0.022 } } do
  moon[#moon + 1] = p -- the horns and the bite
end
for _, p in ipairs(moon) do p[1] = p[1] + 0.006 end

-- Anticlockwise about the origin, which sees all of them.
sorter_solids.outlines = {
  cube = { { 0.018, -0.018 }, { 0.018, 0.018 }, { -0.018, 0.018 }, { -0.018, -0.018 } },
  cylinder = polar(round), prism = polar(prism), star = polar(star), moon = moon,
}
local turns = { cube = 4, cylinder = 16, prism = 3, star = 5, moon = 1 } -- how it looks the same
local flat = { cube = true, cylinder = true, prism = true }              -- convex

-- `holds`: { x, y, yaw, width } of grasps from above, whose fingers close across their y.
function sorter_solids.make(name, colour, holds)
  local half = sorter_solids.height / 2
  local grasps = {}
  for _, g in ipairs(holds) do
    for _, side in ipairs { 0, math.pi } do
      grasps[#grasps + 1] = { at = { g[1], g[2], 0.011 }, rpy = { math.pi, 0, g[3] + side }, width = g[4], approach = 0.08, force = 15 }
    end
  end
  return object {
    type = name, traits = { "movable", "graspable" }, mass = 0.04, friction = 0.5, colour = colour,
    shapes = cutouts.solid(sorter_solids.outlines[name], -half, half, flat[name]), grasps = grasps,
    regions = { seat = { at = { 0, 0, -half }, size = { 0.002, 0.002, 0.002 } } },
    numbers = { turns = turns[name], room = 0.1 },
  }
end

return sorter_solids
