-- The object's centre is in the container's inner region, or in the region itself.
return predicate {
  params = { "obj: movable", "box" },
  label = "the {obj} is inside the {box}",
  settle = 0.1, -- s
  holds = function(w, obj, box)
    local inner = w:has_trait(box, "container") and box .. ".inside" or box
    return w:exists(inner) and w:type(inner) == "region" and w:inside(inner, obj)
  end,
  sample = function(w, obj, box, rng)
    local inner = w:has_trait(box, "container") and box .. ".inside" or box
    return w:region_spots(inner, obj, rng)
  end,
}
