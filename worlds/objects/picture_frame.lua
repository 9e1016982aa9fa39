-- A small picture in a deep wooden frame, 12 x 15 cm; its front looks along +x, behind it is a bar to hang it by.
local wood, art = { 0.45, 0.26, 0.12 }, 0.0094
local grasps = {}
for _, y in ipairs { 0, 0.02, -0.02 } do
  for _, side in ipairs { 1, -1 } do -- from above, one finger behind the frame
    grasps[#grasps + 1] = { at = { 0, y, 0.063 }, rpy = { math.pi, 0, side * math.pi / 2 }, width = 0.026, approach = 0.07, force = 40 }
  end
end

return object {
  type = "picture", traits = { "movable", "graspable" }, mass = 0.15, colour = wood, friction = 0.6,
  shapes = {
    box { 0.026, 0.12, 0.022, at = { 0, 0, 0.064 } },
    box { 0.026, 0.12, 0.022, at = { 0, 0, -0.064 } },
    box { 0.026, 0.022, 0.106, at = { 0, 0.049, 0 } },
    box { 0.026, 0.022, 0.106, at = { 0, -0.049, 0 } },
    box { 0.022, 0.076, 0.106, at = { -0.002, 0, 0 }, colour = { 0.60, 0.82, 0.95 } },                             -- sky
    box { 0.001, 0.076, 0.040, at = { art, 0, -0.033 }, colour = { 0.25, 0.55, 0.22 }, collides = false },         -- meadow
    cylinder { 0.014, 0.001, at = { art, 0.016, 0.028 }, rpy = { 0, math.pi / 2, 0 }, colour = { 0.98, 0.80, 0.15 }, collides = false },
    box { 0.001, 0.024, 0.030, at = { art + 0.0005, -0.014, -0.012 }, colour = { 0.80, 0.25, 0.20 }, collides = false }, -- house
    -- the bar, 14 mm off the back on two blocks
    box { 0.005, 0.056, 0.008, at = { -0.0295, 0, 0.030 }, colour = { 0.6, 0.6, 0.62 } },
    box { 0.014, 0.008, 0.008, at = { -0.0200, 0.024, 0.030 }, colour = { 0.6, 0.6, 0.62 } },
    box { 0.014, 0.008, 0.008, at = { -0.0200, -0.024, 0.030 }, colour = { 0.6, 0.6, 0.62 } },
  },
  regions = { loop = { at = { -0.0295, 0, 0.026 }, rpy = { 0, math.pi / 2, 0 }, size = { 0.008, 0.04, 0.005 } } },
  grasps = grasps,
}
