-- The drawer, door or lid is shut, to within its play.
return predicate {
  params = { "part: openable" },
  label = "the {part} is closed",
  settle = 0.1, -- s
  margin_unit = "m or rad",
  holds = function(w, part)
    local left = w:number(part, "closed_at") - w:joint(part)
    return left >= 0, left
  end,
  sample = function(w, part) return w:joint_at(part, 0) end,
}
