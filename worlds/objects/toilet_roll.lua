-- A half-used toilet roll, narrow enough for the hand: 66 mm thick, 95 mm long, a hole of 43 mm along z.
local grasps = {}
for i = 0, 15 do
  local around = (i + 0.5) * math.pi / 8 -- the hand comes from there; two facets of sixteen lie between the fingers
  for _, side in ipairs { 1, -1 } do
    grasps[#grasps + 1] = {
      at = { 0.005 * math.cos(around), 0.005 * math.sin(around), 0 }, width = 0.065, approach = 0.09, force = 15,
      rpy = { side > 0 and 0 or math.pi, -side * math.pi / 2, around },
    }
  end
end

return object {
  type = "toilet_roll", traits = { "movable", "graspable" }, mass = 0.08, colour = { 0.96, 0.95, 0.92 }, friction = 0.6,
  shapes = {
    lathe { { 0.033, -0.0475 }, { 0.033, 0.0475 }, wall = 0.0115 },
    lathe { { 0.0215, -0.048 }, { 0.0215, 0.048 }, wall = 0.0015, colour = { 0.66, 0.53, 0.38 }, collides = false },
  },
  numbers = { turns = 16, ends = 2 }, -- how it looks the same on a rod
  grasps = grasps,
}
