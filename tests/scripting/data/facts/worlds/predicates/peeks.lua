-- A predicate that reads facts, which it may not.
return predicate {
  params = { "x: target" },
  label = "the {x} peeks",
  holds = function(w) return w:fact("hand_empty") end,
}
