-- Plug the charger that lies on the table into the wall socket.
return task {
  objects = {
    outlet = { "outlet", at = on_table { between(0.18, 0.34), between(-0.20, 0.20) }, yaw = between(-0.42 * math.pi, 0.42 * math.pi) },
    charger = { "charger" },
  },
  init = { is.on("charger", "table"), is_not.crowds("outlet", "charger"), is.reachable("charger") },
  goal = { is.in_slot("charger", "outlet.socket") },
  instructions = {
    "plug the charger into the wall",
    "give the charger power: its pins belong in the socket",
    "push both pins of the charger into the outlet",
    "connect the charger that lies on the table to the socket",
  },
}
