-- The hand holds nothing.
return predicate {
  params = { "hand: hand" },
  label = "the hand is empty",
  settle = 0.1, -- s
  holds = function(w, _) return w:grasped_object() == nil end,
}
