-- A box in the air in which to hold something up.
return object {
  type = "region", traits = { "floating", "container" },
  region = { size = { 0.08, 0.08, 0.08 }, visible = true }, colour = { 0.3, 0.8, 0.3, 0.3 },
}
