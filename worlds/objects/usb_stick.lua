-- A USB stick; its plug points along +x.
local grasps = {}
for _, least in ipairs { 0, 6, 12 } do
  for _, side in ipairs { 1, -1 } do -- from above, leaning back from what it is plugged in, by up to 18 degrees
    local low, high = math.rad(least), math.rad(least + 6)
    grasps[#grasps + 1] = { at = { between(-0.012, -0.005), 0, between(0.004 + least * 0.0001, 0.006 + least * 0.0001) }, width = 0.020, approach = 0.07,
      force = 40, rpy = { 0, side > 0 and between(math.pi - high, math.pi - low) or between(low - math.pi, high - math.pi),
        side > 0 and 0 or math.pi } }
  end
end

return object {
  type = "usb_stick", traits = { "movable", "graspable" }, mass = 0.02, colour = "red", friction = 0.5,
  shapes = {
    box { 0.045, 0.020, 0.012 },
    box { 0.014, 0.0125, 0.0048, at = { 0.0295, 0, 0 }, colour = { 0.80, 0.80, 0.83 } },
    box { 0.012, 0.0202, 0.0122, at = { -0.012, 0, 0 }, colour = { 0.92, 0.92, 0.92 }, collides = false },
  },
  regions = { seat = { at = { 0.0365, 0, 0 }, rpy = { 0, -math.pi / 2, 0 }, size = { 0.0048, 0.0125, 0.001 } } },
  numbers = { behind = 0.06 },
  grasps = grasps,
}
