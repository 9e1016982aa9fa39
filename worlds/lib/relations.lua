-- Where things are beside others, seen from above. The one point of view is that of somebody who stands opposite the robot
-- and looks at it, as the front camera does: left is -y of its base, right +y; what is further from the robot is in front,
-- what is nearer to it is beyond.
local relations = {}

local far = 0.22 -- m: how far beside a thing places are looked for first

-- Level unit vectors, by the predicate's name.
local function direction(w, name)
  local _, _, yaw = w:base():rpy()
  local c, s = math.cos(yaw), math.sin(yaw)
  if name == "left_of" then return s, -c end
  if name == "right_of" then return -s, c end
  if name == "in_front_of" then return c, s end
  return -c, -s
end

-- How far the thing's box reaches from its middle along a level direction.
local function reach(w, thing, x, y)
  local at = w:pose(thing)
  local from_x, from_y = at:position()
  local sizes, sum = { w:size(thing) }, 0.0
  for i, axis in ipairs { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } do
    local to_x, to_y = at:along(axis[1], axis[2], axis[3]):position()
    sum = sum + math.abs((to_x - from_x) * x + (to_y - from_y) * y) * sizes[i] / 2
  end
  return sum
end

-- From one to the other: the level way, and its direction; straight ahead where one is above the other.
local function way(w, from, to)
  local x, y = w:position(from)
  local u, v = w:position(to)
  local length = math.sqrt((u - x) ^ 2 + (v - y) ^ 2)
  if length < 1e-6 then return 0, direction(w, "in_front_of") end
  return length, (u - x) / length, (v - y) / length
end

-- The whole of it is on that side of the other one, and it is no further off to either hand than it is on that side (m).
function relations.beside(w, name, obj, other)
  local x, y = direction(w, name)
  local from_x, from_y = w:position(other)
  local to_x, to_y = w:position(obj)
  local ahead = (to_x - from_x) * x + (to_y - from_y) * y
  local across = math.abs((to_y - from_y) * x - (to_x - from_x) * y)
  local margin = math.min(ahead - reach(w, obj, x, y) - reach(w, other, x, y), ahead - across)
  return margin >= 0, margin
end

-- At most so far from each other, from box to box.
function relations.near(w, obj, other, most)
  local length, x, y = way(w, obj, other)
  local level = length - reach(w, obj, x, y) - reach(w, other, x, y)
  local above = math.max(w:bottom(obj) - w:top(other), w:bottom(other) - w:top(obj))
  local margin = most - math.max(level, above)
  return margin >= 0, margin
end

-- The whole of it is past the one and before the other, no further beside the line from middle to middle than a quarter of
-- that line's length.
function relations.between(w, obj, one, other)
  local length, x, y = way(w, one, other)
  local from_x, from_y = w:position(one)
  local to_x, to_y = w:position(obj)
  local along = (to_x - from_x) * x + (to_y - from_y) * y
  local across = math.abs((to_y - from_y) * x - (to_x - from_x) * y)
  local own = reach(w, obj, x, y)
  local margin = math.min(along - own - reach(w, one, x, y), length - along - own - reach(w, other, x, y), length / 4 - across)
  return margin >= 0, margin
end

-- Surfaces that the thing stands on, or all where it stands on none.
local function level_with(w, thing)
  local x, y = w:position(thing)
  local own, all = {}, w:objects("surface")
  for _, surface in ipairs(all) do
    local beside = w:region_distance(surface, x, y, (w:bottom(surface) + w:top(surface)) / 2)
    if math.abs(w:bottom(thing) - w:top(surface)) < 0.02 and beside <= 0 then own[#own + 1] = surface end
  end
  return #own > 0 and own or all
end

-- Free places of the thing on what the other one stands on, at most x and y from the middle along its axes.
local function spots(w, obj, other, rng, middle, x, y)
  local list = {}
  for _, surface in ipairs(level_with(w, other)) do
    for _, spot in ipairs(w:free_spots(surface, obj, rng, middle, x, y)) do list[#list + 1] = spot end
  end
  return list
end

-- Places for `holds` to be tested at: beside the other one, close to it first.
function relations.places_beside(w, name, obj, other, rng)
  local x, y = direction(w, name)
  local close = reach(w, other, x, y) + far / 2
  local at_x, at_y, z = w:position(other)
  local close_by = pose(at_x + close * x, at_y + close * y, z, 0, 0, math.atan(y, x))
  local list = spots(w, obj, other, rng, close_by, far / 2, close)
  if #list > 0 then return list end
  local all = pose(at_x + x, at_y + y, z, 0, 0, math.atan(y, x))
  return spots(w, obj, other, rng, all, 1, 1)
end

-- Around the other one, at most so far from its box.
function relations.places_near(w, obj, other, most, rng)
  local own_x, own_y = w:size(obj)
  local x, y = w:size(other)
  local out = most + (math.max(own_x, own_y) + math.max(x, y)) / 2
  local at_x, at_y, z = w:position(other)
  return spots(w, obj, other, rng, pose(at_x, at_y, z), out, out)
end

-- On the line between the two.
function relations.places_between(w, obj, one, other, rng)
  local length, x, y = way(w, one, other)
  local at_x, at_y, z = w:position(one)
  local middle = pose(at_x + length / 2 * x, at_y + length / 2 * y, z, 0, 0, math.atan(y, x))
  return spots(w, obj, one, rng, middle, length / 2, length / 4)
end

return relations
