-- The object lies wholly outside the marked area. A condition on starts.
return predicate {
  params = { "obj: movable", "area: marked" },
  label = "the {obj} lies outside the {area}",
  start_only = true,
  holds = function(w, obj, area)
    local x, y = w:position(obj)
    local area_x, area_y = w:position(area)
    local obj_long, obj_wide = w:size(obj)
    local area_long, area_wide = w:size(area)
    local reach = math.max(obj_long, obj_wide) / 2 + math.max(area_long, area_wide) / 2
    return math.sqrt((x - area_x) ^ 2 + (y - area_y) ^ 2) >= reach + 0.02
  end,
}
