-- A place in the air.
return object { type = "region", traits = { "target" }, colour = "green", region = { size = { 0.05, 0.05, 0.05 }, visible = true } }
