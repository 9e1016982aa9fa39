-- The drawer, door or lid is shut, to within its play.
return predicate {
  params = { "part: openable" },
  label = "the {part} is closed",
  settle = 0.1, -- s
  holds = function(w, part) return w:joint(part) <= w:number(part, "closed_at") end,
  sample = function(w, part) return w:joint_at(part, 0) end,
}
