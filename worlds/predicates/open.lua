-- The drawer, door or lid is open far enough to be used.
return predicate {
  params = { "part: openable" },
  label = "the {part} is open",
  settle = 0.1, -- s
  mutex = { "closed" },
  holds = function(w, part) return w:joint(part) >= w:number(part, "open_at") end,
  sample = function(w, part, rng)
    local _, upper = w:joint_range(part)
    return w:joint_between(part, w:number(part, "open_at"), upper, rng)
  end,
}
