-- The object lies with its +x end towards the thing: within 5 degrees, seen from above, and its top is up.
local most = math.rad(5)

local function turn_to(w, obj, aim, at)
  local x, y = at:position()
  local ax, ay = w:position(aim)
  local fx, fy, fz = at:along(1, 0, 0):position()
  local _, _, up = at:along(0, 0, 1):position()
  local _, _, z = at:position()
  local off = math.atan(ay - y, ax - x) - math.atan(fy - y, fx - x)
  return math.atan(math.sin(off), math.cos(off)), up - z > 0.9 and math.abs(fz - z) < 0.3
end

return predicate {
  params = { "obj: pointable", "aim: aim" },
  label = "the {obj} points at the {aim}",
  settle = 0.1, -- s
  margin_unit = "rad",
  holds = function(w, obj, aim)
    local off, upright = turn_to(w, obj, aim, w:pose(obj))
    return upright and math.abs(off) <= most, upright and most - math.abs(off) or math.min(0, most - math.abs(off))
  end,
  sample = function(w, obj, aim, rng) -- on the widest surface
    local widest, most_area = "table", 0.0
    for _, surface in ipairs(w:objects("surface")) do
      local x, y = w:size(surface)
      if x * y > most_area then widest, most_area = surface, x * y end
    end
    return each(w:free_spots(widest, obj, rng), function(spot)
      return spot:turned((turn_to(w, obj, aim, spot)) + rng:between(-0.5, 0.5) * most)
    end)
  end,
}
