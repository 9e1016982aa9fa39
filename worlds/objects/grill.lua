-- A low charcoal grill for the table: a fire box on four feet under a grate; its frame is on top of the grate.
local steel, iron, wood = { 0.70, 0.71, 0.73 }, { 0.13, 0.13, 0.14 }, { 0.55, 0.33, 0.16 }

local shapes = {
  box { 0.28, 0.20, 0.008, at = { 0, 0, -0.004 }, visible = false }, -- what rests on the bars touches this plane
  box { 0.264, 0.184, 0.032, at = { 0, 0, -0.038 }, -- glowing coals
    texture = noise { { 0.75, 0.20, 0.05 }, { 0.12, 0.10, 0.10 }, size = 0.04 } },
  box { 0.28, 0.008, 0.046, at = { 0, 0.096, -0.031 }, colour = iron }, -- the fire box
  box { 0.28, 0.008, 0.046, at = { 0, -0.096, -0.031 }, colour = iron },
  box { 0.008, 0.184, 0.046, at = { 0.136, 0, -0.031 }, colour = iron },
  box { 0.008, 0.184, 0.046, at = { -0.136, 0, -0.031 }, colour = iron },
  box { 0.28, 0.008, 0.008, at = { 0, 0.096, -0.004 }, colour = steel, collides = false }, -- the frame of the grate
  box { 0.28, 0.008, 0.008, at = { 0, -0.096, -0.004 }, colour = steel, collides = false },
  box { 0.02, 0.10, 0.02, at = { 0.152, 0, -0.035 }, colour = wood }, -- handles
  box { 0.02, 0.10, 0.02, at = { -0.152, 0, -0.035 }, colour = wood },
}
for i = -9, 9 do
  shapes[#shapes + 1] = box { 0.006, 0.19, 0.006, at = { i * 0.0152, 0, -0.003 }, colour = steel, collides = false }
end
for _, corner in ipairs { { 1, 1 }, { 1, -1 }, { -1, 1 }, { -1, -1 } } do
  shapes[#shapes + 1] = cylinder { 0.010, 0.016, at = { corner[1] * 0.12, corner[2] * 0.08, -0.062 }, colour = iron }
end

return object {
  type = "grill", traits = { "movable", "surface", "support" },
  shapes = shapes, mass = 4, friction = 0.6, colour = { 0.13, 0.13, 0.14 },
}
