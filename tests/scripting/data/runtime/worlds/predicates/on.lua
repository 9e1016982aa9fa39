-- The object rests on the surface.
return predicate {
  params = { "obj: movable", "below: surface" },
  label = "the {obj} is on the {below}",
  settle = 0.1,
  holds = function(w, obj, below) return w:supports(below, obj) end,
  sample = function(w, obj, below, rng) return w:free_spots(below, obj, rng) end,
}
