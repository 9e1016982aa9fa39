-- A wooden rack on the table with one free compartment between two others; it leans back and is open towards -x.
local slant = deg(15)                      -- of the way out, above the horizontal
local inner, board, depth = 0.066, 0.008, 0.115 -- m
local middle, back = 0.085, 0.010          -- m: height of the bottom of the compartment; the board behind it
local wood, dark = { 0.55, 0.36, 0.20 }, { 0.42, 0.27, 0.15 }

-- From the frame of the compartment (z out of it, y across, x down) to that of the rack.
local function place(x, y, z)
  return { 0.05 - z * math.cos(slant) - x * math.sin(slant), y, middle + z * math.sin(slant) - x * math.cos(slant) }
end
local function slab(x, y, z, sx, sy, sz, colour)
  return box { sx, sy, sz, at = place(x, y, z), rpy = { 0, slant - math.pi / 2, 0 }, colour = colour }
end

local pitch = inner + board
local shapes = {
  slab(pitch / 2, 0, depth / 2, board, 3 * pitch + board, depth), slab(-pitch / 2, 0, depth / 2, board, 3 * pitch + board, depth),
  slab(0, 0, -back / 2, pitch + board, 3 * pitch + board, back, dark),
}
for _, y in ipairs { -1.5, -0.5, 0.5, 1.5 } do shapes[#shapes + 1] = slab(0, y * pitch, depth / 2, inner, board, depth) end
for _, y in ipairs { -1.25, 1.25 } do -- feet
  shapes[#shapes + 1] = box { 0.16, 0.02, 0.014, at = { 0, y * pitch, 0.007 }, colour = dark }
  shapes[#shapes + 1] = box { 0.02, 0.02, 0.060, at = { 0.03, y * pitch, 0.030 }, colour = dark }
  shapes[#shapes + 1] = box { 0.02, 0.02, 0.070, at = { -0.03, y * pitch, 0.035 }, colour = dark }
end

return object {
  type = "wine_rack", traits = {}, fixed = true, colour = wood, friction = 0.4, shapes = shapes,
  regions = { -- from 5 mm behind its back to 2 cm before its front; the bottle lies on its floor
    compartment = {
      at = place(0.002, 0, (depth - 0.005 - 0.02) / 2), rpy = { 0, slant - math.pi / 2, 0 },
      size = { 0.06, 0.06, depth + 0.005 - 0.02 }, traits = { "slot" }, numbers = { gap = 0.009, deep = 0.014, askew = deg(8) },
    },
  },
}
