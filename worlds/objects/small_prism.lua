-- A small wooden triangular prism that stands on a triangle: sides of 4.4 cm with blunt edges, 3.2 cm high.
local function outline(side, blunt) -- an equilateral triangle about the origin, `blunt` cut off at each corner
  local points = {}
  for k = 0, 2 do
    local angle = k * 2 * math.pi / 3
    local x, y = side / math.sqrt(3) - blunt * math.cos(math.pi / 6), blunt / 2
    for _, across in ipairs { -y, y } do
      local px, py = x * math.cos(angle) - across * math.sin(angle), x * math.sin(angle) + across * math.cos(angle)
      points[#points + 1] = { px, py, -0.016 }
      points[#points + 1] = { px, py, 0.016 }
    end
  end
  return points
end

local grasps = {} -- from above: the blunt edge of a corner and the face behind it are parallel
for k = 0, 5 do
  local angle = k * math.pi / 3
  local off = (k % 2 == 0 and 1 or -1) * 0.0045 -- m from the axis to the middle between both
  grasps[#grasps + 1] = {
    at = { off * math.cos(angle), off * math.sin(angle), -0.002 }, rpy = { math.pi, 0, angle + math.pi / 2 },
    width = 0.037, force = 10,
  }
end

return object {
  type = "prism", traits = { "movable", "graspable" },
  shape = hull(outline(0.048, 0.006)), mass = 0.03, colour = "green", grasps = grasps,
}
