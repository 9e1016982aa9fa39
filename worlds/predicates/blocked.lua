-- A door, lid or drawer that the place is behind is not open.
return predicate {
  params = { "place" },
  label = "something shut is before the {place}",
  derived = exists("?part: openable", { is.behind("place", "?part"), is_not.open("?part") }),
}
