-- Where furniture that stands on the floor can be: behind the work table, or to its left or right; its open side, -x, looks
-- over the table, but not straight.
local places = {}

-- `gap`: from the table's edge to the middle of the thing, m; `side`: how far it may be from the middle of the table's far
-- edge, m; `turn`: how far it may be turned, rad; `z`: of its frame.
function places.round_the_table(gap, side, turn, z)
  local near, far = gap, gap + 0.04
  return one_of {
    { at = { between(0.40 + near, 0.40 + far), between(-side, side), z }, yaw = between(-turn, turn) },
    { at = { between(0.06, 0.24), between(0.38 + near, 0.38 + far), z },
      yaw = between(math.pi / 2 - turn, math.pi / 2 + turn) },
    { at = { between(0.06, 0.24), between(-0.38 - far, -0.38 - near), z },
      yaw = between(-math.pi / 2 - turn, turn - math.pi / 2) },
  }
end

return places
