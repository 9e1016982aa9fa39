-- The air from 15 cm above the table upwards: what a hand holds there is well off the table. Its frame is its centre.
return object {
  type = "region", traits = { "floating", "container" },
  region = { size = { 0.42, 0.76, 0.30 } }, -- as wide as the table
}
