-- A bell pepper of a colour, 6.4 cm across and 7 cm high, with its stalk on top; its frame is in its middle.
local looks = { green = { 0.13, 0.48, 0.12 }, red = { 0.80, 0.10, 0.08 }, yellow = { 0.95, 0.78, 0.10 } }

return function(colour)
  return object {
    type = "pepper", traits = { "movable", "graspable" }, mass = 0.16, friction = 0.6, rolling = 0.002, colour = looks[colour],
    shapes = {
      lathe { { 0.018, -0.035 }, { 0.026, -0.030 }, { 0.031, 0.000 }, { 0.032, 0.018 }, { 0.026, 0.030 }, { 0.012, 0.033 } },
      cylinder { 0.005, 0.018, at = { 0, 0, 0.040 }, colour = { 0.20, 0.42, 0.12 }, collides = false },
    },
    grasps = (function()
      local list = {}
      for k = 0, 11 do
        list[#list + 1] = { at = { 0, 0, 0.010 }, rpy = { math.pi, 0, k * math.pi / 6 }, width = 0.064, force = 20 }
      end
      return list
    end)(),
  }
end
