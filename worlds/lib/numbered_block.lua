-- A light cube of 4.5 cm edges with its number in strokes on the top and on all four sides.
local half, thick, stroke, width, height = 0.0225, 0.0006, 0.0045, 0.016, 0.028 -- m
local across, right, level = width + stroke, width / 2, height / 2

local top, middle, bottom = { 0, level, across, stroke }, { 0, 0, across, stroke }, { 0, -level, across, stroke }
local function upright(x, y) return { x, y, stroke, height / 2 + stroke } end

local digits = { -- strokes: x, y, width, height on the face
  { { 0, 0, stroke, height + stroke }, { -stroke, level, stroke * 2, stroke }, { 0, -level, across * 0.8, stroke } },
  { top, upright(right, level / 2), middle, upright(-right, -level / 2), bottom },
  { top, upright(right, level / 2), middle, upright(right, -level / 2), bottom },
}

local faces = { -- right, up and out of each face
  { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
  { { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } },
  { { 0, -1, 0 }, { 0, 0, 1 }, { -1, 0, 0 } },
  { { -1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },
  { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
}

return function(number)
  local shapes = { box { 2 * half, 2 * half, 2 * half } }
  for _, face in ipairs(faces) do
    for _, line in ipairs(digits[number]) do
      local size, at = {}, {}
      for i = 1, 3 do
        size[i] = math.abs(line[3] * face[1][i]) + math.abs(line[4] * face[2][i]) + math.abs(thick * face[3][i])
        at[i] = line[1] * face[1][i] + line[2] * face[2][i] + half * face[3][i]
      end
      shapes[#shapes + 1] = box { size[1], size[2], size[3], at = at, colour = "navy", collides = false }
    end
  end
  return object {
    type = "cube", traits = { "movable", "graspable", "support", "stackable" },
    shapes = shapes, mass = 0.06, colour = { 0.93, 0.87, 0.70 }, attributes = { digit = ({ "one", "two", "three" })[number] },
  }
end
