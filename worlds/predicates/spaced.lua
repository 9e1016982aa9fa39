-- The two are at least 12 cm from each other, middle to middle. A condition on starts.
return predicate {
  params = { "a", "b" },
  label = "the {a} keeps its distance from the {b}",
  start_only = true,
  margin_unit = "m", -- how much nearer they could be
  holds = function(w, a, b)
    local beyond = w:distance(a, b) - 0.12
    return beyond >= 0, beyond
  end,
}
