-- Two things stand next to each other, at most 9 cm from middle to middle.
return predicate {
  params = { "obj: movable", "other: movable" },
  label = "the {obj} is beside the {other}",
  ends_when = "moved",
  settle = 0.1,
  holds = function(w, obj, other)
    local x, y = w:position(obj)
    local a, b = w:position(other)
    return (x - a) ^ 2 + (y - b) ^ 2 < 0.09 ^ 2 and math.abs(w:bottom(obj) - w:bottom(other)) < 0.01
  end,
  sample = function(w, obj, other, rng)
    local x, y, _ = w:position(other)
    local _, _, yaw = w:pose(obj):rpy()
    local spots = {}
    for i = 1, 16 do
      local angle = rng:between(-math.pi, math.pi)
      spots[i] = pose(x + 0.08 * math.cos(angle), y + 0.08 * math.sin(angle), w:bottom(other) + w:below(obj), 0, 0, yaw)
    end
    return spots
  end,
}
