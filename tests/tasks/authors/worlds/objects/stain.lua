-- A stain on the table, until it has been wiped.
return object {
  type = "stain", traits = {}, fixed = true, colour = { 0.35, 0.20, 0.10 },
  declares = { types = { stain = { parent = "fixture" } } },
  shapes = { cylinder { 0.03, 0.001, collides = false, shows = is_not.wiped("self") } },
}
