-- A sirloin steak, 2.4 cm thick, with a rim of fat along one side.
local slanting = require "worlds.lib.slanting"

local function slab(outline, colour) -- two levels: the edges are a little rounded
  local points = {}
  for _, p in ipairs(outline) do
    points[#points + 1] = { p[1] * 0.96, p[2], -0.012 }
    points[#points + 1] = { p[1], p[2], 0 }
    points[#points + 1] = { p[1] * 0.96, p[2], 0.012 }
  end
  points.colour = colour
  return hull(points)
end

return object {
  type = "meat", traits = { "movable", "graspable" }, mass = 0.22,
  nouns = "beef",
  shapes = {
    slab({ { -0.065, -0.010 }, { -0.060, 0.022 }, { -0.045, -0.031 }, { 0.045, -0.031 }, { 0.062, -0.018 }, { 0.062, 0.022 } }, { 0.52, 0.10, 0.09 }),
    slab({ { -0.060, 0.022 }, { -0.045, 0.031 }, { 0.045, 0.031 }, { 0.062, 0.022 } }, { 0.96, 0.86, 0.72 }),
    box { 0.006, 0.044, 0.001, at = { -0.03, -0.003, 0.0121 }, yaw = deg(-25), colour = { 0.22, 0.06, 0.04 }, collides = false },
    box { 0.006, 0.044, 0.001, at = { 0.0, -0.003, 0.0121 }, yaw = deg(-25), colour = { 0.22, 0.06, 0.04 }, collides = false },
    box { 0.006, 0.044, 0.001, at = { 0.03, -0.003, 0.0121 }, yaw = deg(-25), colour = { 0.22, 0.06, 0.04 }, collides = false },
  },
  grasps = slanting.flat({ 0.124, 0.062, 0.024 }, 20),
}
