-- A work table, small enough that the arm reaches all of its top; its frame is at the centre of the top.
return object {
  type = "furniture", traits = { "surface", "support" }, colour = { 0.72, 0.55, 0.38 }, friction = 0.6,
  shapes = {
    box { 0.42, 0.76, 0.04, at = { 0, 0, -0.02 } },
    box { 0.04, 0.04, 0.71, at = { 0.18, 0.35, -0.395 } },
    box { 0.04, 0.04, 0.71, at = { 0.18, -0.35, -0.395 } },
    box { 0.04, 0.04, 0.71, at = { -0.18, 0.35, -0.395 } },
    box { 0.04, 0.04, 0.71, at = { -0.18, -0.35, -0.395 } },
  },
}
