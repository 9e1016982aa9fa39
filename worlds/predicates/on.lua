-- The object rests on the support: held up by it from below, not by a hand.
return predicate {
  params = { "obj: movable", "below: support" },
  label = "the {obj} is on the {below}",
  settle = 0.1, -- s
  requires = "touching",
  holds = function(w, obj, below) return w:supports(below, obj) end,
  sample = function(w, obj, below, rng)
    if w:has_trait(below, "stackable") then return w:stack_spots(below, obj, rng) end
    return w:free_spots(below, obj, rng)
  end,
}
