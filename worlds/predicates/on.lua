-- The object rests on the support: held up by it from below, not by a hand.
return predicate {
  params = { "obj: movable", "below: support" },
  label = "the {obj} is on the {below}",
  settle = 0.1, -- s
  requires = "touching",
  holds = function(w, obj, below) return w:supports(below, obj) end,
  sample = function(w, obj, below, rng)
    if w:exists(below .. ".mouth") then -- a lid: its frame, at the rim, comes to the mouth
      return w:pose(below .. ".mouth"):offset(0, 0, 0.001):turned(rng:between(-math.pi, math.pi))
    end
    if w:has_trait(below, "stackable") then return w:stack_spots(below, obj, rng) end
    return w:free_spots(below, obj, rng)
  end,
}
