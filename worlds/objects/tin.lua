-- A small tin: 4.4 cm across and 6 cm high, with a paper band in its colour.
local grasps = {} -- from above across the lid's edge, any way round
for k = 0, 11 do
  grasps[#grasps + 1] = {
    at = { 0, 0, 0.016 }, rpy = { math.pi, 0, k * math.rad(30) }, width = 0.044, approach = 0.08, force = 15,
  }
end

return object {
  type = "tin", traits = { "movable", "graspable" }, colour = "red", mass = 0.08,
  shapes = {
    cylinder { 0.022, 0.06, colour = { 0.78, 0.79, 0.80 } },
    cylinder { 0.0223, 0.044, collides = false },
  },
  grasps = grasps,
}
