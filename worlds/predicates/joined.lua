-- The object is a part that its joint still holds: a cap that has not been unscrewed.
return predicate {
  params = { "obj: threaded" },
  label = "the {obj} is screwed on",
  settle = 0.1, -- s
  holds = function(w, obj) return w:joined(obj) end,
}
