-- A dish with upright walls, 14 cm across, that stands where it is.
return object {
  type = "dish", traits = { "container", "hollow" }, fixed = true, friction = 0.8, colour = { 0.92, 0.92, 0.88 },
  declares = { types = { dish = { parent = "fixture" } } },
  shapes = { lathe { { 0.07, 0 }, { 0.07, 0.05 }, wall = 0.005 }, cylinder { 0.068, 0.005, at = { 0, 0, 0.0025 } } },
  regions = { inside = { at = { 0, 0, 0.025 }, size = { 0.13, 0.13, 0.05 } } },
}
