-- A zone of 5 cm that reaches into the table.
return object {
  type = "region", traits = { "floating", "container" },
  region = { size = { 0.05, 0.05, 0.12 }, visible = true }, colour = { 0.3, 0.8, 0.3, 0.3 },
}
