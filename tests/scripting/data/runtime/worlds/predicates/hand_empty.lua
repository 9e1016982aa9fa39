-- The hand holds nothing.
return predicate { params = { "hand: hand" }, label = "the hand is empty", holds = function(w) return w:grasped_object() == nil end }
