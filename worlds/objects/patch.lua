-- A coloured square of 11 cm on the table to drag something onto; its frame is on the table.
return object {
  type = "area", traits = { "marked", "pad" }, fixed = true, colour = "green",
  shape = box { 0.11, 0.11, 0.001, at = { 0, 0, 0.0005 }, collides = false },
}
