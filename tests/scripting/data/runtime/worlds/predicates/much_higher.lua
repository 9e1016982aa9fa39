-- By the height of a cube at least.
return predicate {
  extends = "higher",
  label = "the {a} is much higher than the {b}",
  reads = { weight = {} },
  holds = function(w, a, b)
    local _, _, za = w:position(a)
    local _, _, zb = w:position(b)
    return za - zb >= 0.04 and w:number(a, "weight") < 1, za - zb - 0.04
  end,
}
