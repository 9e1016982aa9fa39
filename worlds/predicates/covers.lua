-- The object rests on the pad, its middle within the area's outline. (`inside` is for what has an inside.)
return predicate {
  params = { "obj: movable", "area: pad" },
  label = "the {obj} lies on the {area}",
  settle = 0.1, -- s
  ends_when = "moved",
  holds = function(w, obj, area)
    local x, y = w:pose(area):inverse():times(w:pose(obj)):position()
    local long, wide = w:size(area)
    local within = math.min(long / 2 - math.abs(x), wide / 2 - math.abs(y)) -- m
    return within >= 0 and math.abs(w:bottom(obj) - w:bottom(area)) < 0.01
  end,
}
