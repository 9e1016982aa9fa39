-- A small wooden moon, a crescent: 4.6 cm high, 3.6 cm broad, 3.2 cm thick.
local outer, inner, shift, half, wedges = 0.023, 0.019, 0.012, 0.016, 6 -- m; the bite is a circle shifted along x
local horn = (outer ^ 2 - inner ^ 2 + shift ^ 2) / (2 * shift) -- x of both horns
local from_outer = math.acos(horn / outer)
local from_inner = math.acos((horn - shift) / inner)

local function corner(i) -- outer and inner end of the i-th cut, from one horn round to the other
  local part = i / wedges
  local a = from_outer + part * 2 * (math.pi - from_outer)
  local b = from_inner + part * 2 * (math.pi - from_inner)
  return outer * math.cos(a), outer * math.sin(a), shift + inner * math.cos(b), inner * math.sin(b)
end

local shapes = {}
for i = 1, wedges do
  local points = {}
  for _, cut in ipairs { i - 1, i - 0.5, i } do
    local ox, oy, ix, iy = corner(cut)
    for _, z in ipairs { -half, half } do
      points[#points + 1] = { ox, oy, z }
      if cut ~= i - 0.5 then points[#points + 1] = { ix, iy, z } end -- hollow inside: no corner there
    end
  end
  shapes[i] = hull(points)
end

local grasps = {}
for _, turn in ipairs { 0, math.pi } do
  grasps[#grasps + 1] = { at = { 0, 0, -0.002 }, rpy = { math.pi, 0, turn }, width = 0.045, force = 10 } -- around it
  grasps[#grasps + 1] = { at = { -0.014, 0, -0.002 }, rpy = { math.pi, 0, turn + math.pi / 2 }, width = 0.018, force = 10 } -- a finger in the bite
end

return object {
  type = "moon", traits = { "movable", "graspable" },
  shapes = shapes, mass = 0.03, colour = "purple", grasps = grasps,
}
