-- The arm can open the drawer, door or lid, which is shut where it starts, or shut it, which is open, or turn the knob: two
-- of its grasps at least are in reach, and the arm can go with the part from there, with more than one grip where it must.
-- A condition on starts.
return predicate {
  params = { "part" },
  label = "the {part} is where the arm can move it",
  start_only = true,
  holds = function(w, part)
    if w:has_trait(part, "turnable") then return w:can_move(part, "turn_to", nil, "turned_at") end
    if w:joint(part) > w:number(part, "closed_at") then return w:can_move(part, "closed_at") end
    return w:can_move(part, "pull", nil, "open_at")
  end,
}
