-- The thing is in the box and the box is shut: a fact in two parts.
return predicate {
  params = { "obj: movable", "box: box" },
  label = "the {obj} is put away in the {box}",
  derived = all_of { is.inside("obj", "box"), is.closed("box.lid") },
}
