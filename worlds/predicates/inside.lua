-- The object's centre is in the container's inner region, or in the region itself.
local function inner(w, box) return w:exists(box .. ".inside") and box .. ".inside" or box end

-- Near the front of a shelf, where the hand need not go deep: anywhere across it; upright; as the object points into the
-- shelf, or as the hand does that holds it, give or take a turn.
local function shelf_spots(w, obj, shelf, rng)
  local most, margin, turn, held = 24, 0.015, 0.2, w:grasped(obj)
  local region = shelf .. ".inside"
  local frame = w:pose(region)
  local deep, wide, high = w:size(region)
  local length, width = w:size(obj)
  local _, _, yaw = w:pose(obj):rpy()
  local poses, to_front = {}, 0.0
  local _, _, into = frame:rpy()
  if held then
    most, turn = 60, 0.8
    local x, y = w:tip():position()
    local ahead_x, ahead_y = w:tip():along(0, 0, 1):position()
    to_front = yaw - math.atan(ahead_y - y, ahead_x - x) -- the object's yaw for a hand that points straight in
  end
  for i = 1, most do
    local share = held and i / most or 1 -- the hand goes straight in where that will do
    local relative = to_front + share * rng:between(-turn, turn)
    local c, s = math.abs(math.cos(relative)), math.abs(math.sin(relative))
    local half_x, half_y = (c * length + s * width) / 2, (s * length + c * width) / 2
    local room = wide / 2 - math.max(half_y + 0.035, 0.115) -- beside the open fingers and the hand, which is 21 cm wide
    if not held then room = 0.75 * room end -- so that it is easily taken off again
    local side = rng:between(-1, 1) * math.max(room, 0)
    local front = -deep / 2 + margin + half_x
    local back = math.max(deep / 2 - half_x, 0.0) -- what is as deep as the shelf, turned, goes in its middle
    local spot = frame:along(math.min(front, back), side, w:below(obj) - high / 2 + 0.001)
    local x, y, z = spot:position()
    local free = true
    for _, other in ipairs(w:objects("movable")) do
      if other ~= obj and w:inside(region, other) then
        local other_x, other_y = w:position(other)
        local other_length, other_width = w:size(other)
        local apart = (math.max(length, width) + math.max(other_length, other_width)) / 2 + 0.02
        local _, _, other_yaw = w:pose(other):rpy()
        local oc, os = math.abs(math.cos(other_yaw - into)), math.abs(math.sin(other_yaw - into))
        local beside = math.abs(math.cos(into) * (other_y - y) - math.sin(into) * (other_x - x)) -- along the shelf
        local near = beside < half_y + (os * other_length + oc * other_width) / 2 + 0.03         -- a finger between both
        if near and (other_x - x) ^ 2 + (other_y - y) ^ 2 < apart ^ 2 then free = false end
      end
    end
    if free then poses[#poses + 1] = pose(x, y, z, 0, 0, into + relative) end
  end
  return poses
end

-- A drawer is looked into when it is open; a box or a shelf of it when one of its doors or lids is.
local function looks_open(w, box)
  if not w:exists(box .. ".inside") then return true end
  if w:has_trait(box, "openable") then return w:joint(box) >= w:number(box, "open_at") end
  local dot = string.find(box, ".")
  local whole = dot and string.sub(box, 1, dot) or box .. "."
  local shut = false
  for _, part in ipairs(w:objects("openable")) do
    if string.sub(part, 1, #whole) == whole then
      if w:joint(part) >= w:number(part, "open_at") then return true end
      shut = true
    end
  end
  return not shut
end

-- Spots that a hand can get at from above, where the container says which (numbers `hand_front` and `hand_back`: least and
-- greatest x in its frame, `hand_side`: greatest |y|, m), turned at most `hand_turn` (rad) out of its own directions, so that
-- the palm has room.
local function handy(w, obj, box, spots)
  local front, back, side = w:number(box, "hand_front") or -1, w:number(box, "hand_back") or 1, w:number(box, "hand_side") or 1
  local turn = w:number(box, "hand_turn") or math.pi
  local kept, from = {}, w:pose(box):inverse()
  for _, spot in ipairs(spots) do
    local inside = from:times(spot)
    local x, y = inside:position()
    local _, _, yaw = inside:rpy()
    local off = (yaw + math.pi / 4) % (math.pi / 2) - math.pi / 4
    ---@type number
    local less = math.max(1 - turn / (math.pi / 4), 0)
    if x <= back and x >= front and math.abs(y) <= side then kept[#kept + 1] = spot:rotated(0, 0, -less * off) end
  end
  return kept
end

-- What the hand holds goes where `handy` allows, the hand along the sides of the box: first with its fingers to either
-- side, then to front and back. In a box that more than one thing goes into, its number `hand_aside` is the least |y|.
local function handed(w, obj, box, rng)
  local _, _, high = w:size(inner(w, box))
  local x, y = w:tip():position()
  local finger_x, finger_y = w:tip():along(0, 1, 0):position()
  local _, _, yaw = w:pose(obj):rpy()
  local off = yaw - math.atan(finger_y - y, finger_x - x) + math.pi / 2 -- of the object, its fingers to either side of the box
  local least, most, turn = w:number(box, "hand_aside"), w:number(box, "hand_side"), w:number(box, "hand_turn")
  local poses = {}
  for i = 1, 48 do
    local quarter = (i % 2 * 2 + (i > 24 and 1 or 0)) * math.pi / 2
    local side = (i % 4 < 2 and 1 or -1) * rng:between(least, most)
    poses[i] = w:pose(inner(w, box)):along(rng:between(w:number(box, "hand_front"), w:number(box, "hand_back")), side,
      w:below(obj) - high / 2 + 0.003):rotated(0, 0, off + quarter + rng:between(-turn, turn))
  end
  return poses
end

-- On a spot that says how things lie there: `folds` is how many ways round they may (1: as the spot, 2: or the other way, …).
local function aligned(w, obj, spot, folds, rng)
  local _, _, high = w:size(spot)
  local poses = {}
  for i = 1, 12 do
    local yaw = (i % folds) * 2 * math.pi / folds + rng:between(-0.03, 0.03)
    poses[i] = w:pose(spot):along(rng:between(-0.002, 0.002), rng:between(-0.002, 0.002), w:below(obj) - high / 2 + 0.003):rotated(0, 0, yaw)
  end
  return poses
end

return predicate {
  params = { "obj: movable", "box: container" },
  label = "the {obj} is inside the {box}",
  settle = 0.1, -- s
  requires = "near",
  margin_unit = "m", -- how deep in it
  observable = function(w, _, box) return looks_open(w, box) end,
  holds = function(w, obj, box)
    local distance = w:region_distance(inner(w, box), obj)
    return distance <= 0, -distance
  end,
  sample = function(w, obj, box, rng)
    if w:has_trait(box, "shelf") then return shelf_spots(w, obj, box, rng) end
    local folds = w:number(box, "folds")
    if folds > 0 then return aligned(w, obj, box, folds, rng) end
    if w:grasped(obj) and w:number(box, "hand_side") then return handed(w, obj, box, rng) end
    return handy(w, obj, box, w:region_spots(inner(w, box), obj, rng))
  end,
}
