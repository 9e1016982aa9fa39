-- The two stand far enough from each other for a hand between them (8 cm). A condition on starts.
local function far(w, x, y, a, b)
  local bx, by = w:position(b)
  local a_x, a_y = w:size(a)
  local b_x, b_y = w:size(b)
  return math.sqrt((x - bx) ^ 2 + (y - by) ^ 2) >= (math.max(a_x, a_y) + math.max(b_x, b_y)) / 2 + 0.08
end

return predicate {
  params = { "a: movable", "b: movable" },
  label = "the {a} stands apart from the {b}",
  start_only = true,
  holds = function(w, a, b)
    local x, y = w:position(a)
    return far(w, x, y, a, b)
  end,
  sample = function(w, a, b, rng) -- on a surface
    local poses = {}
    for _, surface in ipairs(w:objects("surface")) do
      for _, spot in ipairs(w:free_spots(surface, a, rng)) do
        local x, y = spot:position()
        if far(w, x, y, a, b) then poses[#poses + 1] = spot end
      end
    end
    return poses
  end,
}
