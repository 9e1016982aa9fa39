-- A small tube to stand a folding umbrella in.
return object {
  type = "stand", traits = {}, fixed = true, colour = { 0.80, 0.77, 0.68 }, friction = 0.4,
  shapes = {
    cylinder { 0.046, 0.010, at = { 0, 0, 0.005 } },
    lathe { { 0.038, 0.008 }, { 0.038, 0.15 }, wall = 0.005 },
  },
  regions = { -- from 5 mm under its floor to 2 cm above it
    tube = { at = { 0, 0, 0.0875 }, size = { 0.07, 0.07, 0.165 }, traits = { "slot" }, numbers = { gap = 0.006, deep = 0.011, askew = deg(16) } },
  },
}
