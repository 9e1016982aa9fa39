-- The floor of the room.
return object { type = "fixture", traits = {}, colour = { 0.62, 0.60, 0.57 }, shape = box { 4, 4, 0.1, at = { 0, 0, -0.05 } } }
