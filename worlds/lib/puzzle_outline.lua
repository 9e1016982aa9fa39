-- The outline of the loose piece of the puzzle: 5 cm square, with a knob at +x and another at +y, bays at -x and -y.
local half = 0.025 -- m
local points = {}

-- One side from its right end to its left end, seen from the middle: `out` 1: a knob, -1: a bay.
local function side(turn, out)
  local profile = { { half, -half } }
  if out > 0 then
    for _, p in ipairs { { half, -0.006 }, { half + 0.005, -0.0075 }, { half + 0.009, -0.005 }, { half + 0.009, 0.005 },
      { half + 0.005, 0.0075 }, { half, 0.006 } } do profile[#profile + 1] = p end
  else
    for _, p in ipairs { { half, -0.009 }, { half - 0.006, -0.0065 }, { half - 0.006, 0.0065 }, { half, 0.009 } } do
      profile[#profile + 1] = p
    end
  end
  for _, p in ipairs(profile) do
    table.insert(points, { p[1] * math.cos(turn) - p[2] * math.sin(turn), p[1] * math.sin(turn) + p[2] * math.cos(turn) })
  end
end

side(0, 1)
side(math.pi / 2, 1)
side(math.pi, -1)
side(3 * math.pi / 2, -1)
return points
