-- The arm can turn the knob, tap or hand of a clock, as `workable` has it. A condition on starts.
return predicate {
  params = { "part: turnable" },
  label = "the {part} is where the arm can turn it",
  start_only = true,
  holds = function(w, part) return w:can_move(part, "turn_to", nil, "turned_at") end,
}
