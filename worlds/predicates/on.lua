-- The object rests on the support, which bears it from below. While the hand holds it too, it is on the support until it
-- leaves it: the fact ends at the frame in which pictures show a gap, not when the fingers close.
-- First the spots with room for fingers around them, where the object asks for it (number `room`: m from centre to centre,
-- and most of it to the edge of what stands up beside it), then the others.
local function roomy(w, obj, below, spots)
  local room = w:number(obj, "room")
  if room == 0 or #spots == 0 then return spots end
  local _, _, z = spots[1]:position()
  local others, edges, kept, rest = {}, {}, {}, {}
  for _, other in ipairs(w:objects("movable")) do
    if other ~= obj then others[#others + 1] = { w:position(other) } end
  end
  for _, other in ipairs(w:objects("surface")) do
    local length, width = w:size(other)
    local edge = { from = w:pose(other):inverse(), x = length / 2 + 0.8 * room, y = width / 2 + 0.8 * room }
    if other ~= below and w:top(other) > z - room / 4 then edges[#edges + 1] = edge end
  end
  for _, spot in ipairs(spots) do
    local x, y = spot:position()
    local free = true
    for _, at in ipairs(others) do
      free = free and (at[1] - x) ^ 2 + (at[2] - y) ^ 2 + (at[3] - z) ^ 2 >= room ^ 2
    end
    for _, edge in ipairs(edges) do
      local along, across = edge.from:times(spot):position()
      free = free and (math.abs(along) >= edge.x or math.abs(across) >= edge.y)
    end
    if free then kept[#kept + 1] = spot else rest[#rest + 1] = spot end
  end
  for _, spot in ipairs(rest) do kept[#kept + 1] = spot end
  return kept
end

-- What always stands on its foot (number `stands`) does so however the hand holds it.
local function standing(w, obj, below, spots, rng)
  if w:number(obj, "stands") == 0 then return spots end
  return each(spots, function(spot)
    local x, y = spot:position()
    return pose(x, y, w:top(below) + w:below(obj) + 0.001, 0, 0, rng:between(-math.pi, math.pi))
  end)
end

return predicate {
  params = { "obj: movable", "below: support" },
  label = "the {obj} is on the {below}",
  settle = 0.1, -- s
  requires = "touching",
  margin_unit = "m", -- how far the object's middle is from the edge of the support
  holds = function(w, obj, below) return w:supports(below, obj) end,
  sample = function(w, obj, below, rng)
    if w:exists(below .. ".mouth") then -- a lid: its frame, at the rim, comes to the mouth
      return w:pose(below .. ".mouth"):offset(0, 0, 0.001):turned(rng:between(-math.pi, math.pi))
    end
    if w:has_trait(below, "stackable") then return w:stack_spots(below, obj, rng) end
    return roomy(w, obj, below, standing(w, obj, below, w:free_spots(below, obj, rng), rng))
  end,
}
