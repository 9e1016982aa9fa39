-- The object's centre is in the container's inner region, or in the region itself.
local function inner(w, box) return w:type(box) == "region" and box or box .. ".inside" end

return predicate {
  params = { "obj: movable", "box: container" },
  label = "the {obj} is inside the {box}",
  settle = 0.1, -- s
  holds = function(w, obj, box) return w:inside(inner(w, box), obj) end,
  sample = function(w, obj, box, rng) return w:region_spots(inner(w, box), obj, rng) end,
}
