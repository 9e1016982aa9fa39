-- The first is higher than the second; the margin is by how much.
return predicate {
  params = { "a: movable", "b: movable" },
  label = "the {a} is higher than the {b}",
  holds = function(w, a, b)
    local _, _, za = w:position(a)
    local _, _, zb = w:position(b)
    return za > zb, za - zb -- m
  end,
  sample = function(w, a, b, rng)
    return { w:pose(b):offset(0, 0, 0.1), w:pose(b):offset(0, 0, rng:between(0.2, 0.3)) }
  end,
}
