-- The flat object touches the surface with its far edge and slants up from there to the hand that holds it.
local slant = deg(38)
local hand = 0.25 -- m, from the tip back

-- Does nothing else stand as close as `radius` to a place above the surface, seen from above?
local function free(w, obj, below, place, radius)
  local _, _, z = place:position()
  local floor = math.max(w:top(below) + 0.002, z - radius)
  for _, other in ipairs(w:objects()) do
    local kind = w:type(other)
    if other ~= obj and kind ~= "region" and kind ~= "hand" and w:top(other) > floor then
      local beside = place:offset(0, 0, math.min(math.max(z, w:bottom(other)), w:top(other)) - z)
      if w:region_distance(other, beside) < radius then return false end
    end
  end
  return true
end

-- Is there room for the palm, from here until it has drawn back?
local function free_for_palm(w, obj, below, tip)
  for _, back in ipairs { 0.06, 0.13 } do
    for _, side in ipairs { -0.08, 0, 0.08 } do
      if not free(w, obj, below, tip:along(0, side, -back), 0.05) then return false end
    end
  end
  return true
end

return predicate {
  params = { "obj: movable & flat", "below: surface" },
  label = "the {obj} leans on the {below}",
  settle = 0.1, -- s
  requires = "touching",
  holds = function(w, obj, below) return w:grasped(obj) and w:touching(below, obj) end,
  sample = function(w, obj, below, rng)
    local length, width, thickness = w:size(obj)
    local radius = math.max(length, width) / 2
    local held = w:pose(obj):inverse() * w:tip()
    local hx, hy = held:position()
    local towards_hand = math.atan(hy, hx)
    local table_length, table_width = w:size(below)
    local outside, poses = {}, {}
    for _ = 1, 64 do
      local x = rng:between(radius - table_length / 2 + 0.01, table_length / 2 - radius - 0.01)
      local y = rng:between(radius - table_width / 2 + 0.01, table_width / 2 - radius - 0.01)
      local bx, by = w:pose(below):along(x, y, 0):position()
      local lying = pose(bx, by, w:top(below) + thickness / 2 + 0.001, 0, 0, rng:between(-math.pi, math.pi))
      -- turned about the edge that is away from the hand
      local spot = lying:rotated(0, 0, towards_hand):along(-radius, 0, 0):rotated(0, -slant, 0):along(radius, 0, 0)
        :rotated(0, 0, -towards_hand)
      if free(w, obj, below, lying, radius + 0.01) and free_for_palm(w, obj, below, spot * held) then
        local hand_x, hand_y = (w:pose(below):inverse() * spot * held):along(0, 0, -hand):position()
        outside[spot] = math.max(math.abs(hand_x) - table_length / 2, 0) + math.max(math.abs(hand_y) - table_width / 2, 0)
        poses[#poses + 1] = spot
      end
    end
    table.sort(poses, function(a, b) return outside[a] < outside[b] end) -- the arm stays over the surface
    return poses
  end,
}
