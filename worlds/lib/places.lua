-- Where furniture that stands on the floor can be: at the work table's sides; its open side, -x, looks over the table, but
-- not straight.
local places = {}

-- To the left (`sign` 1) or the right (-1).
local function at_side(sign, gap, turn, z)
  local near, far = 0.38 + gap, 0.38 + gap + 0.04
  local y = sign > 0 and between(near, far) or between(-far, -near)
  local yaw = sign * math.pi / 2
  return { at = { between(0.06, 0.24), y, z }, yaw = between(yaw - turn, yaw + turn) }
end

-- To the left or right of the table. `gap`: from its edge to the middle of the thing, m; `turn`: how far it may be turned,
-- rad; `z`: of its frame, m. What is tall belongs there: behind the table it would hide everything from the camera in front.
function places.beside_the_table(gap, turn, z) return one_of { at_side(1, gap, turn, z), at_side(-1, gap, turn, z) } end

-- Behind the table too, up to 22 cm from the middle of that edge.
function places.round_the_table(gap, turn, z)
  local behind = { at = { between(0.40 + gap, 0.44 + gap), between(-0.22, 0.22), z }, yaw = between(-turn, turn) }
  return one_of { behind, at_side(1, gap, turn, z), at_side(-1, gap, turn, z) }
end

return places
