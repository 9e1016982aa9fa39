-- A thin post that stands on the table; its frame is at the middle of its foot.
return object {
  type = "furniture", traits = { "support" }, fixed = true, colour = "grey",
  shapes = { box { 0.012, 0.012, 0.024, at = { 0, 0, 0.012 } } },
}
