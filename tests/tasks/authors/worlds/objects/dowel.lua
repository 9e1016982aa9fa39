-- A round peg, 10 cm high, that stands on its end.
return object {
  type = "peg", traits = { "movable", "graspable" }, mass = 0.05, colour = { 0.80, 0.62, 0.38 },
  shape = cylinder { 0.012, 0.10 },
  regions = { seat = { at = { 0, 0, -0.05 }, size = { 0.02, 0.02, 0.002 } } }, -- the end that goes in
  numbers = { turns = 8 },
}
