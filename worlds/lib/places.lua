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

-- At its side towards +y (`sign` 1) or -y (-1).
local function at_side(sign, how)
  local yaw = sign * math.pi / 2 + (how.lean or 0)
  return turned(how.turn, how.wide, function(from, to, further)
    local close, away = 0.38 + how.gap + further, 0.38 + how.gap + further + 0.04
    local y = sign > 0 and between(close, away) or between(-away, -close)
    return { at = on_table { between(0.06, how.far or 0.24), y, how.above or 0 }, yaw = between(yaw + from, yaw + to) }
  end)
end

-- Across the table from the robot.
local function across(how)
  return turned(how.turn, how.wide, function(from, to, further)
    return { at = on_table { between(0.40 + how.gap + further, 0.44 + how.gap + further), between(-0.22, 0.22), how.above or 0 },
      yaw = between(from, to) }
  end)
end

local function any_of_them(...)
  local all = {}
  for _, list in ipairs { ... } do
    for _, place in ipairs(list) do all[#all + 1] = place end
  end
  return one_of(all)
end

-- Each takes `gap`: from the table's edge to the middle of the thing, m; `turn`: how far it may be turned, rad; and as wanted
--   above  its frame above the table's top, m (0)
--   wide   how wide its front is, m, where it is turned so far that it must stand further away
--   lean   by how much what stands at a side is turned from facing straight across, rad: a door that opens wide has its
--          hinge, to the right of who stands before it, further from the arm then (0)
--   far    the greatest x of what stands at a side, m (0.24)
-- Sides of the table are named as relations are (lib/relations.lua), by who stands opposite the robot: +y is on the right.

-- At either side of the table. What is tall belongs there: across it, it would hide everything from the camera in front.
function places.beside_the_table(how) return any_of_them(at_side(1, how), at_side(-1, how)) end

-- On the right, +y, or across: for what has a door that would be between the arm and its inside on the left.
function places.right_or_across(how) return any_of_them(across(how), at_side(1, how)) end

-- At any of these three sides.
function places.round_the_table(how) return any_of_them(across(how), at_side(1, how), at_side(-1, how)) end

return places
