-- A beacon lights once its cap has been pressed.
return task {
  world = "tabletop",
  objects = { beacon = { "beacon", at = { 0.25, between(-0.15, 0.15), 0.75 } } },
  goal = is.pressed("beacon.cap"),
  instructions = { "light the beacon" },
}
