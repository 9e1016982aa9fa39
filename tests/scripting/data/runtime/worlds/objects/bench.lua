-- A slab; its frame is at the centre of the top.
return object { type = "fixture", traits = { "surface" }, friction = 0.7, shape = box { 1, 1, 0.1, at = { 0, 0, -0.05 } } }
