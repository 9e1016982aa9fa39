-- A low block to put things on; its frame is at the centre of its top.
return object {
  type = "furniture", traits = { "surface", "support" }, colour = { 0.3, 0.3, 0.7 },
  shape = box { 0.16, 0.16, 0.02, at = { 0, 0, -0.01 } },
}
