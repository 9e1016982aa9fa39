-- Pull the charger out of the wall socket.
return task {
  objects = {
    outlet = { "outlet", at = on_table { between(0.18, 0.34), between(-0.20, 0.20) }, yaw = between(-0.42 * math.pi, 0.42 * math.pi) },
    charger = { "charger" },
  },
  init = { is.in_slot("charger", "outlet.socket") },
  goal = { is_not.in_slot("charger", "outlet.socket"),
    any_of { is.lifted("charger"), all_of { is.on("charger", "table"), is.hand_empty() } } },
  instructions = {
    "free the socket by pulling out the charger",
    "pull the charger's plug clear of the wall",
    "the charger draws power for nothing: unplug it",
    "pull the charger out of the outlet",
  },
}
