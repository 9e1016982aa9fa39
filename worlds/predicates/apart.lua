-- The two stand far enough from each other for a hand between them (8 cm). A condition on starts.
local function room(w, x, y, a, b) -- m, more than that
  local bx, by = w:position(b)
  local a_x, a_y = w:size(a)
  local b_x, b_y = w:size(b)
  return math.sqrt((x - bx) ^ 2 + (y - by) ^ 2) - (math.max(a_x, a_y) + math.max(b_x, b_y)) / 2 - 0.08
end

return predicate {
  params = { "a: movable", "b: movable" },
  label = "the {a} stands apart from the {b}",
  start_only = true,
  margin_unit = "m", -- how much nearer they could be
  holds = function(w, a, b)
    local x, y = w:position(a)
    local beyond = room(w, x, y, a, b)
    return beyond >= 0, beyond
  end,
  sample = function(w, a, b, rng) -- on a surface
    local poses = {}
    for _, surface in ipairs(w:objects("surface")) do
      for _, spot in ipairs(w:free_spots(surface, a, rng)) do
        local x, y = spot:position()
        if room(w, x, y, a, b) >= 0 then poses[#poses + 1] = spot end
      end
    end
    return poses
  end,
}
