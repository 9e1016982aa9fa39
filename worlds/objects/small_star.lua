-- A small wooden star of five blunt points: 5 cm across, 3.2 cm high.
local tips, outer, inner, blunt, half = 5, 0.026, 0.0135, 0.003, 0.016 -- m

local function at(radius, angle, across) -- two points, one above the other
  local x = radius * math.cos(angle) - across * math.sin(angle)
  local y = radius * math.sin(angle) + across * math.cos(angle)
  return { x, y, -half }, { x, y, half }
end

local function ring(list)
  local points = {}
  for _, p in ipairs(list) do
    points[#points + 1], points[#points + 2] = at(p[1], p[2], p[3] or 0)
  end
  return hull(points)
end

local shapes, grasps, core = {}, {}, {}
for k = 0, tips - 1 do
  local angle, step = k * 2 * math.pi / tips, math.pi / tips
  shapes[#shapes + 1] = ring { { 0, 0 }, { inner, angle - step }, { inner, angle + step },
    { outer - 0.002, angle, -blunt }, { outer - 0.002, angle, blunt } }
  for _, turn in ipairs { angle - math.pi / 2, angle + math.pi / 2 } do -- one pad on a point, the other in the notch behind it
    grasps[#grasps + 1] = {
      at = { 0.003 * math.cos(angle), 0.003 * math.sin(angle), -0.002 }, rpy = { math.pi, 0, turn },
      width = 0.042, force = 10,
    }
  end
end

return object {
  type = "star", traits = { "movable", "graspable" },
  shapes = shapes, mass = 0.03, colour = "yellow", grasps = grasps,
}
