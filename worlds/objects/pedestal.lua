-- What the arm stands on; its frame is at the top.
return object {
  type = "fixture", traits = {}, colour = { 0.25, 0.26, 0.28 },
  shape = box { 0.24, 0.24, 0.74, at = { 0, 0, -0.375 } },
}
