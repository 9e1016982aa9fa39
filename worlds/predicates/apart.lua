-- At the start the two stand far enough from each other for a hand between them (6 cm); never asked again.
return predicate {
  params = { "a: movable", "b: movable" },
  label = "the {a} stands apart from the {b}",
  static = true,
  holds = function(w, a, b)
    local ax, ay = w:position(a)
    local bx, by = w:position(b)
    local a_x, a_y = w:size(a)
    local b_x, b_y = w:size(b)
    local reach = math.max(a_x, a_y) / 2 + math.max(b_x, b_y) / 2
    return math.sqrt((ax - bx) ^ 2 + (ay - by) ^ 2) >= reach + 0.06
  end,
}
