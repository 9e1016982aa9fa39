-- Here nobody knows that an open drawer covers those below it: that it is in the way has to be found out.
return predicate {
  params = { "place", "part: openable" },
  label = "the {place} is under the {part}",
  static = true,
  holds = function() return false end,
}
