-- An area on the table to push things into; nothing collides with it.
return object {
  type = "region", traits = { "marked", "container" },
  region = { size = { 0.12, 0.12, 0.10 }, visible = true }, colour = { 0.9, 0.8, 0.2, 0.4 },
}
