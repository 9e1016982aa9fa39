-- The arm can open the drawer, door or lid, which is shut where it starts, or shut it, which is open: two of its grasps at
-- least are in reach, and the arm can go with the part from there, with more than one grip where it must. A condition on
-- starts.
return predicate {
  params = { "part: openable" },
  label = "the {part} is where the arm can move it",
  start_only = true,
  holds = function(w, part)
    if w:joint(part) > w:number(part, "closed_at") then return w:can_move(part, "closed_at") end
    return w:can_move(part, "pull", nil, "open_at")
  end,
}
