-- The hand can take hold of it where it is: two of its grasps at least are in reach and free. A condition on starts.
return predicate {
  params = { "obj: graspable" },
  label = "the {obj} is where a hand can take it",
  start_only = true,
  holds = function(w, obj) return w:can_grasp(obj) end,
}
