-- What sits in a slot or hangs on a hook. Slots and hooks are regions whose +z is the way out or off.
local seats = {}

-- The place of a thing that goes in: its region `seat`, else its origin.
function seats.seat(w, obj) return w:exists(obj .. ".seat") and obj .. ".seat" or obj end

-- The middle of the loop or hole that it hangs by: its region `loop`, else its origin.
function seats.loop(w, obj) return w:exists(obj .. ".loop") and obj .. ".loop" or obj end

-- The body or part that a region belongs to.
function seats.owner(region)
  local last = 0
  for i = 1, #region do
    if string.sub(region, i, i) == "." then last = i end
  end
  return last > 0 and string.sub(region, 1, last - 1) or region
end

-- The pose of `obj` at which its part `place` lies at `wanted`.
function seats.with_part_at(w, obj, place, wanted) return wanted * w:pose(place):inverse() * w:pose(obj) end

-- All poses at which it looks the same there: turned about the way in or along the rod as often as its number `turns`
-- says (1: not at all), and the other way round where its number `ends` is 2.
function seats.all_with_part_at(w, obj, place, wanted)
  local poses, turns = {}, w:number(obj, "turns")
  for turn = 0, turns - 1 do
    local turned = wanted:rotated(0, 0, 2 * math.pi * turn / turns)
    poses[#poses + 1] = seats.with_part_at(w, obj, place, turned)
    if w:number(obj, "ends") == 2 then
      poses[#poses + 1] = seats.with_part_at(w, obj, place, turned:rotated(math.pi, 0, 0))
    end
  end
  return poses
end

-- How little the hand likes a pose of the object: while it holds it, by how much it must turn, rad; else how far its top
-- is from the hand, m.
---@param w stampede.world_view
local function effort(w, obj, wanted)
  if w:grasped(obj) then
    local _, _, _, scalar = (w:pose(obj):inverse() * wanted):quaternion()
    return 2 * math.acos(math.min(math.abs(scalar), 1))
  end
  local x, y, z = (w:tip():inverse() * wanted):along(0, 0, 0.05):position()
  return math.sqrt(x ^ 2 + y ^ 2 + z ^ 2)
end

-- All poses at which what hangs freely hangs at `wanted`: level, however much the hook rises, and either way round; while it
-- is held also turned about the hook by up to its number `swing`, from where it swings to its rest. The best for the hand
-- come first.
function seats.all_swinging(w, obj, place, wanted)
  local poses, efforts = {}, {}
  local x, y, z = wanted:position()
  local ahead_x, ahead_y = wanted:along(0, 0, 1):position()
  local level = pose(x, y, z, 0, math.pi / 2, math.atan(ahead_y - y, ahead_x - x))
  for _, share in ipairs(w:grasped(obj) and { 0, 0.25, 0.5, 0.75, 1 } or { 0 }) do
    for _, side in ipairs { 0, math.pi } do
      local turned = level:rotated(side, 0, 0):rotated(0, 0, share * w:number(obj, "swing"))
      local there = seats.with_part_at(w, obj, place, turned)
      poses[#poses + 1], efforts[there] = there, effort(w, obj, there)
    end
  end
  table.sort(poses, function(a, b) return efforts[a] < efforts[b] end)
  return poses
end

-- How deep a seat or loop is in its slot or on its hook beyond what counts as seated, m; negative: it is not. The region
-- contains what has not left it yet; seated is more: at most `deep` above the region's lower face, `play` beside its
-- middle, and `askew` (rad) out of its direction (`either_way`: or against it); an angle counts as what it puts a point 10 cm
-- off out by.
---@param w stampede.world_view
function seats.seated(w, obj, place, region, deep, askew, either_way)
  local distance = w:region_distance(region, place)
  if distance > 0 then return -distance end
  local there = w:pose(region):inverse() * w:pose(place)
  local x, y, z = there:position()
  local _, _, up = there:along(0, 0, 1):position()
  local straight = math.max(-1, math.min(up - z, 1))
  if either_way then straight = math.abs(straight) end
  local _, _, length = w:size(region)
  return math.min(-distance, (w:number(region, "deep") or deep) - z - length / 2,
    (w:number(region, "play") or 1) - math.sqrt(x ^ 2 + y ^ 2), 0.1 * ((w:number(region, "askew") or askew) - math.acos(straight)))
end

-- From where `place` is now to `clear` beyond the end of the slot or hook, straight along it: { x, y, z }.
---@param w stampede.world_view
function seats.way_out(w, region, place, clear)
  local _, _, length = w:size(region)
  local _, _, z = (w:pose(region):inverse() * w:pose(place)):position()
  local here, there = w:pose(region), w:pose(region):along(0, 0, length / 2 - z + clear)
  local ax, ay, az = here:position()
  local bx, by, bz = there:position()
  return { bx - ax, by - ay, bz - az }
end

-- How far the object is out of all slots and off all hooks, m; negative while it is in or on one.
function seats.clearance(w, obj)
  local least = math.huge
  for _, slot in ipairs(w:objects("slot")) do least = math.min(least, w:region_distance(slot, seats.seat(w, obj))) end
  for _, hook in ipairs(w:objects("hook")) do least = math.min(least, w:region_distance(hook, seats.loop(w, obj))) end
  return least
end

return seats
