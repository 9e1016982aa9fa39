-- Knives, forks and spoons for a table: 16 cm long, lying flat, their handle towards -x; the frame is in the middle, 8 mm above the
-- table. `head`: the shapes at +x.
local steel = { 0.80, 0.82, 0.85 }

return function(type, head)
  local grasps = {} -- across the handle from above
  for _, x in ipairs { -0.045, -0.030, -0.055 } do
    for _, yaw in ipairs { 0, math.pi } do
      for _, lean in ipairs { 0, 12, -12 } do
        grasps[#grasps + 1] = { at = { x, 0, lean == 0 and 0.0035 or 0.005 }, rpy = { math.pi, math.rad(lean), yaw }, width = 0.014,
          approach = 0.08, force = 20 }
      end
    end
  end
  local shapes = { box { 0.085, 0.014, 0.016, at = { -0.0375, 0, 0 } }, box { 0.025, 0.007, 0.008, at = { 0.014, 0, -0.003 } } }
  for _, shape in ipairs(head) do shapes[#shapes + 1] = shape end
  return object { type = type, traits = { "movable", "graspable" }, mass = 0.05, friction = 0.5, colour = steel, shapes = shapes,
    grasps = grasps, numbers = { grip = -0.045 } }
end
