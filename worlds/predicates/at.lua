-- The tip of the hand is in the target.
return predicate {
  params = { "hand: hand", "place: target" },
  label = "the hand is at the {place}",
  settle = 0.2, -- s
  margin_unit = "m", -- how deep in it
  holds = function(w, _, place)
    local distance = w:region_distance(place, w:tip())
    return distance <= 0, -distance -- m
  end,
}
