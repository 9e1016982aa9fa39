-- A coloured place in the air for the tip of the hand to reach; nothing collides with it.
return object {
  type = "region", traits = { "target" },
  region = { size = { 0.05, 0.05, 0.05 }, visible = true }, colour = "red",
}
