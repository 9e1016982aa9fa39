-- Counts its own calls in an upvalue: a thing that no test may rely on.
local calls, samples, keep = 0, 0, {}
return predicate {
  params = { "obj: movable" },
  label = "the {obj} is counted",
  holds = function(w, obj)
    calls = calls + 1
    keep.w = keep.w or w
    return calls > 1, calls
  end,
  sample = function(w, obj, rng)
    samples = samples + 1
    return { w:pose(obj):offset(samples, 0, 0) }
  end,
}
