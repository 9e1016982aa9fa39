-- A child's shoe, 14.5 cm long and 5.6 cm wide, with its toe at +x; its frame is in its middle, 2.8 cm above the ground.
local leather, sole, lining = { 0.36, 0.20, 0.12 }, { 0.12, 0.11, 0.10 }, { 0.80, 0.70, 0.55 }
local heel, toe, ground = -0.0725, 0.0725, -0.028 -- m

local grasps = {} -- across the heel from above, the hand level or leaning over the toe or back
for _, x in ipairs { heel + 0.026, heel + 0.040 } do
  for _, lean in ipairs { 0, 20, -20 } do
    for _, side in ipairs { 1, -1 } do
      grasps[#grasps + 1] = { at = { x, 0, ground + 0.040 }, width = 0.050, approach = 0.09, force = 30,
        rpy = { math.pi, side * math.rad(lean), side > 0 and 0 or math.pi } }
    end
  end
end

-- Both sides of an outline: { x, half width, height above the ground }.
local function mirrored(points)
  local all = {}
  for _, point in ipairs(points) do
    for _, side in ipairs { 1, -1 } do all[#all + 1] = { point[1], side * point[2], ground + point[3] } end
  end
  return all
end

local bottom = {}
for _, z in ipairs { 0, 0.010 } do
  for _, point in ipairs { { heel, 0.022 }, { heel + 0.05, 0.025 }, { toe - 0.03, 0.028 }, { toe, 0.016 } } do
    bottom[#bottom + 1] = { point[1], point[2], z }
  end
end
local front = mirrored { { heel + 0.066, 0.025, 0.010 }, { heel + 0.066, 0.024, 0.050 }, { toe - 0.03, 0.026, 0.010 },
  { toe - 0.03, 0.020, 0.032 }, { toe - 0.003, 0.014, 0.010 }, { toe - 0.008, 0.004, 0.024 } }

local under = hull(mirrored(bottom))
under.colour = sole

return object {
  type = "shoe", traits = { "movable", "graspable" }, mass = 0.22, friction = 0.7, colour = leather, grasps = grasps,
  shapes = {
    under,
    hull(front),
    box { 0.066, 0.050, 0.046, at = { heel + 0.035, 0, ground + 0.033 } }, -- round the heel
    box { 0.050, 0.038, 0.001, at = { heel + 0.037, 0, ground + 0.0563 }, colour = lining, collides = false }, -- what it is open to
    box { 0.030, 0.016, 0.001, at = { heel + 0.085, 0, ground + 0.0448 }, rpy = { 0, 0.40, 0 }, colour = lining, collides = false }, -- laces
  },
}
