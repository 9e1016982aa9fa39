-- Where furniture that stands on the floor can be: at the work table's sides; its open side, -x, looks over the table, but
-- not straight.
local places = {}

-- To the left (`sign` 1) or the right (-1).
local function at_side(sign, gap, turn, z, lean, far)
  local close, away = 0.38 + gap, 0.38 + gap + 0.04
  local y = sign > 0 and between(close, away) or between(-away, -close)
  local yaw = sign * math.pi / 2 + (lean or 0)
  return { at = { between(0.06, far or 0.24), y, z }, yaw = between(yaw - turn, yaw + turn) }
end

-- To the left or right of the table. `gap`: from its edge to the middle of the thing, m; `turn`: how far it may be turned,
-- rad; `z`: of its frame, m. What is tall belongs there: behind the table it would hide everything from the camera in front.
-- `lean`: by how much what stands at a side is turned from facing straight across, rad: a door that opens wide has its hinge, to
-- the right of who stands before it, further from the arm then. `far`: its greatest x, m.
function places.beside_the_table(gap, turn, z, lean, far)
  return one_of { at_side(1, gap, turn, z, lean, far), at_side(-1, gap, turn, z, lean, far) }
end

-- Behind the table, up to `most` m (default 0.22) from the middle of that edge.
function places.behind_the_table(gap, turn, z, most)
  most = most or 0.22
  return { at = { between(0.40 + gap, 0.44 + gap), between(-most, most), z }, yaw = between(-turn, turn) }
end

-- To the left of the table or behind it: for what has a door that would be between the arm and its inside on the right.
function places.left_or_behind(gap, turn, z, lean)
  return one_of { places.behind_the_table(gap, turn, z), at_side(1, gap, turn, z, lean) }
end

-- At any of the three sides.
function places.round_the_table(gap, turn, z, lean)
  return one_of { places.behind_the_table(gap, turn, z), at_side(1, gap, turn, z, lean), at_side(-1, gap, turn, z, lean) }
end

return places
