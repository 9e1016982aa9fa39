-- A thing stands close before another one, as the robot sees them.
return predicate {
  params = { "guard: movable", "obj: movable" },
  label = "the {guard} guards the {obj}",
  ends_when = "moved",
  settle = 0.1,
  holds = function(w, guard, obj)
    local x, y, z = w:position(guard)
    local a, b, c = w:position(obj)
    return a > x and a - x < 0.12 and math.abs(b - y) < 0.03 and math.abs(c - z) < 0.02
  end,
}
