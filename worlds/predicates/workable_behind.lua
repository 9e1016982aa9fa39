-- The arm can open what is shut behind the door, once that is open. A condition on starts.
return predicate {
  params = { "part: openable", "door: openable" },
  label = "the {part} is where the arm can move it once the {door} is open",
  start_only = true,
  holds = function(w, part, door) return w:can_move(part, "pull", door, "open_at") end,
}
