-- The hand holds the object.
return predicate {
  params = { "hand: hand", "obj: movable" },
  label = "the hand holds the {obj}",
  holds = function(w, _, obj) return w:grasped(obj) end,
}
