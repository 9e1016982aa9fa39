-- A telephone charger: a block with two pins; they point along +x.
-- A hand that comes from above, leaning back from the wall by so many degrees, 10 more or less; near the middle.
local function leaning(degrees, side)
  local least, most = math.rad(degrees - 10), math.rad(degrees + 10)
  -- tip z: down and forward (+x); tip y: across the block
  return {
    at = { between(-0.009, 0.002), 0, between(0.003, 0.008) }, width = 0.044, approach = 0.08,
    rpy = { 0, side > 0 and between(math.pi - most, math.pi - least) or between(least - math.pi, most - math.pi),
      side > 0 and 0 or math.pi },
  }
end

return object {
  type = "charger", traits = { "movable", "graspable" }, mass = 0.06, colour = { 0.12, 0.12, 0.13 },
  shapes = {
    box { 0.050, 0.044, 0.034 },
    box { 0.010, 0.030, 0.026, at = { -0.029, 0, 0 }, colour = { 0.25, 0.45, 0.85 } },
    box { 0.020, 0.006, 0.006, at = { 0.035, 0.010, 0 }, colour = { 0.80, 0.80, 0.82 } },
    box { 0.020, 0.006, 0.006, at = { 0.035, -0.010, 0 }, colour = { 0.80, 0.80, 0.82 } },
  },
  regions = { seat = { at = { 0.045, 0, 0 }, rpy = { 0, -math.pi / 2, 0 }, size = { 0.006, 0.026, 0.002 } } },
  numbers = { behind = 0.10 },
  grasps = { leaning(28, 1), leaning(28, -1), leaning(38, 1), leaning(38, -1), leaning(48, 1), leaning(48, -1) },
}
