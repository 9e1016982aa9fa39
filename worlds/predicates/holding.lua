-- The hand holds the object by friction between its pads.
return predicate {
  params = { "hand: hand", "obj: movable" },
  label = "the hand holds the {obj}",
  settle = 0.1, -- s
  functional = true, mutex = { "hand_empty" },
  requires = "held",
  margin_unit = "m", -- how deep the tip is in the object's box
  holds = function(w, _, obj) return w:grasped(obj) end,
}
