-- The base of a cordless phone: a wedge whose slanted top has a seat with low walls for the phone on its back.
local slant = deg(12)
local grey, dark = { 0.72, 0.72, 0.74 }, { 0.30, 0.31, 0.34 }
local length, width, middle = 0.176, 0.076, 0.038 -- m; the height of the middle of the floor of the seat

-- A place on the slanted floor of the seat: along it, across it, out of it.
local function on_floor(x, y, z)
  return { x * math.cos(slant) - z * math.sin(slant), y, middle + x * math.sin(slant) + z * math.cos(slant) }
end

-- A wall of the seat whose inner face leans outwards, so that the phone slides in.
local function wall(x0, x1, y0, y1, lean_x, lean_y)
  local points = { colour = dark }
  for _, x in ipairs { x0, x1 } do
    for _, y in ipairs { y0, y1 } do
      points[#points + 1] = on_floor(x, y, -0.001)
      local inner_x, inner_y = lean_x ~= 0 and x == x0, lean_y ~= 0 and y == y0
      points[#points + 1] = on_floor(x + (inner_x and lean_x or 0), y + (inner_y and lean_y or 0), 0.006)
    end
  end
  return hull(points)
end

local wedge = { colour = grey }
for _, x in ipairs { -length / 2, length / 2 } do
  for _, y in ipairs { -width / 2, width / 2 } do
    wedge[#wedge + 1] = on_floor(x, y, 0)
    local foot = on_floor(x, y, 0)
    wedge[#wedge + 1] = { foot[1] + (x < 0 and -0.004 or 0.004), y * 1.1, 0 }
  end
end

return object {
  type = "phone_cradle", traits = { "movable" }, mass = 0.4, friction = 0.6, colour = grey,
  shapes = {
    hull(wedge),
    wall(-0.078, 0.070, 0.0255, 0.034, 0, 0.003), wall(-0.078, 0.070, -0.0255, -0.034, 0, -0.003),
    wall(-0.0775, -0.086, -0.034, 0.034, -0.003, 0), -- the lower end; the upper one is open for the aerial
    box { 0.006, 0.006, 0.002, at = on_floor(-0.030, 0, 0), rpy = { 0, -slant, 0 }, colour = { 0.85, 0.70, 0.25 }, collides = false },
    box { 0.006, 0.006, 0.002, at = on_floor(-0.050, 0, 0), rpy = { 0, -slant, 0 }, colour = { 0.85, 0.70, 0.25 }, collides = false },
    cylinder { 0.004, 0.002, at = on_floor(0.080, -0.030, 0.001), rpy = { 0, -slant, 0 }, colour = { 0.9, 0.1, 0.1 }, collides = false },
  },
  regions = { -- 2 mm under the floor to 3 mm above it: a phone across the walls is not in it
    seat = { at = on_floor(0, 0, 0.0005), rpy = { 0, -slant, 0 }, size = { 0.016, 0.016, 0.005 }, traits = { "slot" },
      numbers = { gap = 0.003, deep = 0.0045, askew = deg(3) } },
  },
}
