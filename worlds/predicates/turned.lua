-- The knob, tap or hand of a clock has been turned as far as it should.
return predicate {
  params = { "part: turnable" },
  label = "the {part} is turned",
  settle = 0.1, -- s
  margin_unit = "rad",
  holds = function(w, part)
    local beyond = w:joint(part) - w:number(part, "turned_at")
    return beyond >= 0, beyond
  end,
  sample = function(w, part)
    local _, most = w:joint_range(part)
    return w:joint_at(part, math.min(w:number(part, "turn_to"), most))
  end,
}
