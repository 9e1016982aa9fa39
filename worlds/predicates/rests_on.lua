-- What is put on the spot rests on what is on the other one, which is the next below and reaches under it.
return predicate {
  params = { "spot: raised", "below: spot" },
  label = "what is on the {spot} rests on what is on the {below}",
  static = true,
  holds = function(w, spot, below)
    local x, y, z = w:position(spot)
    local _, _, other = w:position(below)
    local _, _, height = w:size(below)
    if other >= z - 0.005 or other < z - 1.5 * height then return false end
    local px, py = w:pose(below):inverse():times(w:pose(spot)):position()
    local long, wide = w:size(below)
    return math.abs(px) < long and math.abs(py) < 1.5 * wide
  end,
}
