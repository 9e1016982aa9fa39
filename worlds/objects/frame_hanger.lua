-- A stand with a hook to hang a picture on and a buffer that keeps it upright; both point along +x.
local steel = { 0.30, 0.31, 0.34 }

return object {
  type = "stand", traits = {}, fixed = true, colour = steel, friction = 0.4,
  shapes = {
    box { 0.15, 0.14, 0.012, at = { 0.03, 0, 0.006 }, colour = { 0.50, 0.38, 0.26 } },
    box { 0.020, 0.050, 0.146, at = { 0, 0, 0.073 }, colour = { 0.50, 0.38, 0.26 } },
    box { 0.0500, 0.012, 0.008, at = { 0.0345, 0, 0.142 } },             -- arm
    box { 0.0050, 0.012, 0.016, at = { 0.0570, 0, 0.146 } },             -- its tip, 8 mm up
    box { 0.0565, 0.050, 0.012, at = { 0.03825, 0, 0.065 } },            -- buffer
  },
  regions = { -- where the bar of a frame lies; beyond the tip it is off
    hook = {
      at = { 0.0505, 0, 0.1465 }, rpy = { 0, math.pi / 2, 0 }, size = { 0.04, 0.04, 0.05 },
      traits = { "hook" }, numbers = { lift = 0.018, deep = 0.028, askew = deg(15) },
    },
  },
}
