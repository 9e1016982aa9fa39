-- Lay the bottle of wine that stands on the table into the rack, foot first.
return task {
  objects = {
    rack = { "wine_rack", at = on_table { between(0.20, 0.30), between(-0.18, 0.18) }, yaw = between(-math.pi / 4, math.pi / 4) },
    bottle = { "wine_bottle" },
  },
  init = { is.on("bottle", "table"), is_not.crowds("rack", "bottle") },
  goal = { is.in_slot("bottle", "rack.compartment") },
  instructions = {
    "put the wine into the rack",
    "the bottle belongs in the free compartment of the wine rack",
    "lay the bottle into the rack, foot first",
    "store the bottle of wine that stands on the table in its rack",
  },
}
