-- Nothing rests on the object.
return predicate {
  params = { "x: stackable" },
  label = "nothing is on the {x}",
  derived = is_not(exists("?y: movable", is.on("?y", "x"))),
}
