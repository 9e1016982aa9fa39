-- The object lies wholly outside the marked area. A condition on starts.
return predicate {
  params = { "obj: movable", "area: marked" },
  label = "the {obj} lies outside the {area}",
  start_only = true,
  margin_unit = "m", -- how much nearer it could be
  holds = function(w, obj, area)
    local x, y = w:position(obj)
    local _, _, level = w:position(area)
    local long, wide = w:size(obj)
    local beyond = w:region_distance(area, x, y, level) - math.sqrt(long ^ 2 + wide ^ 2) / 2
    return beyond >= 0, beyond
  end,
}
