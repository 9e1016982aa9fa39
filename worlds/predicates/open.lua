-- The drawer, door or lid is open far enough to be used.
return predicate {
  params = { "part: openable" },
  label = "the {part} is open",
  settle = 0.1, -- s
  margin_unit = "m or rad",
  mutex = { "closed" },
  holds = function(w, part)
    local beyond = w:joint(part) - w:number(part, "open_at")
    return beyond >= 0, beyond
  end,
  sample = function(w, part, rng)
    local _, upper = w:joint_range(part)
    return w:joint_between(part, w:number(part, "open_at"), upper, rng)
  end,
}
