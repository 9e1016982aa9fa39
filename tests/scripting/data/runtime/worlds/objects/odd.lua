-- Free, but without a mass: a mistake.
return object { type = "cube", traits = { "movable" }, shape = box { 0.04, 0.04, 0.04 } }
