-- The hand can take hold of what is behind a door or flap, once that is open. A condition on starts.
return predicate {
  params = { "obj: graspable", "door: openable" },
  label = "the {obj} is where a hand can take it once the {door} is open",
  start_only = true,
  holds = function(w, obj, door) return w:can_grasp(obj, door) end,
}
