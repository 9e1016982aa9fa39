-- A wooden block that slants back, with a slot for a knife that lies flat in it; its frame is under its middle.
local slant = deg(40) -- of the way out, above the horizontal
local wood, cut = { 0.62, 0.42, 0.22 }, { 0.45, 0.29, 0.14 }
local depth, width, gap = 0.128, 0.036, 0.007 -- m: of the slot

-- From the frame of the slot (z out of it, y across, x down and outwards) to that of the block; z = 0 is its bottom.
local function from_slot(x, y, z)
  return { -0.060 + z * math.cos(slant) + x * math.sin(slant), y, 0.055 + z * math.sin(slant) - x * math.cos(slant) }
end

local function slab(x0, x1, y0, y1, z0, z1)
  return box { x1 - x0, y1 - y0, z1 - z0, at = from_slot((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2),
    rpy = { 0, math.pi / 2 - slant, 0 } }
end

local under = {} -- all that is below the slot, down to the table
for _, y in ipairs { -0.045, 0.045 } do
  under[#under + 1] = from_slot(gap / 2, y, -0.015)
  under[#under + 1] = from_slot(gap / 2, y, depth)
  under[#under + 1] = from_slot(gap / 2 + 0.02, y, depth)
  local back, front = from_slot(gap / 2, y, -0.015), from_slot(gap / 2, y, depth)
  under[#under + 1] = { back[1], y, 0 }
  under[#under + 1] = { front[1], y, 0 }
end

local side = width / 2
return object {
  type = "knife_block", traits = { "movable" }, mass = 2, friction = 0.6, colour = wood,
  shapes = {
    hull(under),
    slab(-gap / 2 - 0.016, -gap / 2, -0.045, 0.045, -0.015, depth), -- above the slot
    slab(-gap / 2, gap / 2, side, 0.045, -0.015, depth), slab(-gap / 2, gap / 2, -0.045, -side, -0.015, depth),
    slab(-gap / 2, gap / 2, -side, side, -0.015, -0.002), -- its bottom
    box { gap, width, 0.001, at = from_slot(0, 0, depth - 0.02), rpy = { 0, math.pi / 2 - slant, 0 }, colour = cut, collides = false },
  },
  regions = {
    slot = { at = from_slot(0, 0, (depth - 0.007) / 2), rpy = { 0, math.pi / 2 - slant, 0 },
      size = { 0.03, 0.03, depth + 0.007 }, traits = { "slot" }, numbers = { gap = 0.014, deep = 0.018, askew = deg(5) } },
  },
}
