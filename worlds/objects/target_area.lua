-- A coloured square on the table to push something into; its frame is on the table. A block of 9 cm whose middle is
-- `inside` lies on the square with all or nearly all of its foot.
return object {
  type = "area", traits = { "marked", "container" }, fixed = true, colour = "green",
  shape = box { 0.16, 0.16, 0.001, at = { 0, 0, 0.0005 }, collides = false },
  regions = {
    inside = { at = { 0, 0, 0.03 }, size = { 0.06, 0.06, 0.06 } },
  },
}
