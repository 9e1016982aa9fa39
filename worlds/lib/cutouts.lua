-- Boards with a hole of any outline, and solids of the same outline. An outline is a list of points { x, y }, anticlockwise
-- about the origin, from which all of it can be seen.
local cutouts = {}

-- The outline with every edge `gap` further out: the hole for a solid of that outline, with play.
function cutouts.wider(outline, gap)
  local n, points = #outline, {}
  local function normal(i)
    local a, b = outline[(i - 1) % n + 1], outline[i % n + 1]
    local x, y = b[2] - a[2], a[1] - b[1]
    local length = math.sqrt(x * x + y * y)
    return x / length, y / length
  end
  for i = 1, n do
    local ax, ay = normal(i - 1)
    local bx, by = normal(i)
    local share = gap / (1 + ax * bx + ay * by)
    points[i] = { outline[i][1] + share * (ax + bx), outline[i][2] + share * (ay + by) }
  end
  return points
end

local function prism(points, z0, z1, colour)
  local corners = { colour = colour }
  for _, p in ipairs(points) do
    corners[#corners + 1] = { p[1], p[2], z0 }
    corners[#corners + 1] = { p[1], p[2], z1 }
  end
  return hull(corners)
end

-- A solid of the outline from z0 to z1: one shape where it is convex, else one for each edge.
function cutouts.solid(outline, z0, z1, convex)
  if convex then return { prism(outline, z0, z1) } end
  local shapes = {}
  for i, p in ipairs(outline) do shapes[i] = prism({ { 0, 0 }, p, outline[i % #outline + 1] }, z0, z1) end
  return shapes
end

-- A board 2 half_x × 2 half_y about { x, y } from z0 to z1 with a hole of the outline in its middle: a shape for each edge.
function cutouts.board(outline, x, y, half_x, half_y, z0, z1, colour)
  local function edge(p) -- straight out from the origin to the edge of the board
    local far = math.max(math.abs(p[1]) / half_x, math.abs(p[2]) / half_y)
    return { p[1] / far, p[2] / far }
  end
  local shapes = {}
  for i, a in ipairs(outline) do
    local b = outline[i % #outline + 1]
    local points = { a, b, edge(a), edge(b) }
    for _, corner in ipairs { { half_x, half_y }, { -half_x, half_y }, { -half_x, -half_y }, { half_x, -half_y } } do
      local after, before = a[1] * corner[2] - a[2] * corner[1], corner[1] * b[2] - corner[2] * b[1]
      if after > 0 and before > 0 then points[#points + 1] = corner end
    end
    for k, p in ipairs(points) do points[k] = { p[1] + x, p[2] + y } end
    shapes[i] = prism(points, z0, z1, colour)
  end
  return shapes
end

return cutouts
