-- A door, lid or drawer that the place is behind is not open, or a drawer above it is not shut.
return predicate {
  params = { "place" },
  label = "something is before or above the {place}",
  derived = any_of {
    exists("?part: openable", { is.behind("place", "?part"), is_not.open("?part") }),
    exists("?part: openable", { is.under("place", "?part"), is_not.closed("?part") }),
  },
}
