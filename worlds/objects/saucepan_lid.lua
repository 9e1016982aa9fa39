-- The lid of the saucepan: 16.8 cm across, with a ring that keeps it in the mouth and a knob; its frame is at the rim.
return object {
  type = "lid", traits = { "movable", "graspable" }, colour = { 0.70, 0.72, 0.75 }, mass = 0.25,
  shapes = {
    cylinder { 0.084, 0.005, at = { 0, 0, 0.0025 } },
    cylinder { 0.073, 0.006, at = { 0, 0, -0.003 } }, -- goes into the mouth
    cylinder { 0.045, 0.005, at = { 0, 0, 0.0065 } },
    cylinder { 0.008, 0.010, at = { 0, 0, 0.013 }, colour = { 0.12, 0.12, 0.13 } },
    cylinder { 0.017, 0.022, at = { 0, 0, 0.028 }, colour = { 0.12, 0.12, 0.13 } }, -- the knob
  },
  grasps = (function()
    local list = {}
    for k = 0, 11 do
      list[#list + 1] = { at = { 0, 0, 0.028 }, rpy = { math.pi, 0, k * math.pi / 6 }, width = 0.034, force = 30 }
    end
    return list
  end)(),
}
