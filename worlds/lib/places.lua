-- Where furniture that stands on the floor can be: at the work table's sides; its open side, -x, looks over the table, but
-- not straight.
local places = {}

local step, deep = 0.2, 0.11 -- rad; m: from the middle of the thing to its front, at least

-- What is turned stands further away, so that its front corner does not cut into the table: make(from, to, further) is a
-- place for yaws from `from` to `to` relative to straight, as far further away; each of a few ranges of yaws is as likely.
local function turned(turn, wide, make)
  local count, list = math.max(1, math.ceil(turn / step - 0.01)), {}
  for k = 1, wide and count or 1 do
    local from, to = (k - 1) * turn / count, wide and k * turn / count or turn
    local further = wide and math.max(0, wide / 2 * math.sin(to) - deep * (1 - math.cos(to))) or 0
    list[#list + 1] = make(from, to, further)
    list[#list + 1] = make(-to, -from, further)
  end
  return list
end

-- To the left (`sign` 1) or the right (-1).
local function at_side(sign, gap, turn, z, lean, far, wide)
  local yaw = sign * math.pi / 2 + (lean or 0)
  return turned(turn, wide, function(from, to, further)
    local close, away = 0.38 + gap + further, 0.38 + gap + further + 0.04
    local y = sign > 0 and between(close, away) or between(-away, -close)
    return { at = { between(0.06, far or 0.24), y, z }, yaw = between(yaw + from, yaw + to) }
  end)
end

local function behind(gap, turn, z, most, wide)
  most = most or 0.22
  return turned(turn, wide, function(from, to, further)
    return { at = { between(0.40 + gap + further, 0.44 + gap + further), between(-most, most), z }, yaw = between(from, to) }
  end)
end

local function any_of_them(...)
  local all = {}
  for _, list in ipairs { ... } do
    for _, place in ipairs(list) do all[#all + 1] = place end
  end
  return one_of(all)
end

-- To the left or right of the table. `gap`: from its edge to the middle of the thing, m; `turn`: how far it may be turned,
-- rad; `z`: of its frame, m. What is tall belongs there: behind the table it would hide everything from the camera in front.
-- `lean`: by how much what stands at a side is turned from facing straight across, rad: a door that opens wide has its hinge, to
-- the right of who stands before it, further from the arm then. `far`: its greatest x, m. `wide`: how wide its front is, m,
-- where it is turned so far that it must stand further away.
function places.beside_the_table(gap, turn, z, lean, far, wide)
  return any_of_them(at_side(1, gap, turn, z, lean, far, wide), at_side(-1, gap, turn, z, lean, far, wide))
end

-- Behind the table, up to `most` m (default 0.22) from the middle of that edge.
function places.behind_the_table(gap, turn, z, most, wide) return any_of_them(behind(gap, turn, z, most, wide)) end

-- To the left of the table or behind it: for what has a door that would be between the arm and its inside on the right.
function places.left_or_behind(gap, turn, z, lean, wide)
  return any_of_them(behind(gap, turn, z, nil, wide), at_side(1, gap, turn, z, lean, nil, wide))
end

-- At any of the three sides.
function places.round_the_table(gap, turn, z, lean, wide)
  return any_of_them(behind(gap, turn, z, nil, wide), at_side(1, gap, turn, z, lean, nil, wide),
    at_side(-1, gap, turn, z, lean, nil, wide))
end

return places
