-- The centre of the first is in the region.
return predicate {
  params = { "obj: target", "place: region" },
  label = "the {obj} is inside the {place}",
  holds = function(w, obj, place) return w:inside(place, obj), -w:region_distance(place, w:pose(obj)) end,
  sample = function(w, obj, place, rng) return w:region_spots(place, obj, rng) end,
}
