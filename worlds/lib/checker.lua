-- A man of the game of checkers: a disc 3 cm across and 1.6 cm high; its frame is in its middle.
local grasps = {}
for k = 0, 7 do
  grasps[#grasps + 1] = { at = { 0, 0, 0.004 }, rpy = { math.pi, 0, k * math.pi / 4 }, width = 0.030, approach = 0.06, force = 20 }
end

return function(colour)
  return object {
    type = "checker", traits = { "movable", "graspable" }, mass = 0.03, friction = 0.5, colour = colour,
    shapes = { cylinder { 0.015, 0.016 } },
    visual = { lathe { { 0.001, -0.008 }, { 0.015, -0.008 }, { 0.015, 0.008 }, { 0.012, 0.008 }, { 0.011, 0.006 }, { 0.001, 0.006 }, segments = 24 } },
    grasps = grasps,
  }
end
