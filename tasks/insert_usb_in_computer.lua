-- Plug the USB stick that lies on the table into one of the computer's two ports.
return task {
  objects = {
    computer = { "desktop_computer", at = on_table { between(0.16, 0.24), between(-0.16, 0.16) }, yaw = between(-math.pi, math.pi) },
    stick = { "usb_stick", colour = one_of { "red", "blue", "green", "orange", "magenta" } },
  },
  init = { is.on("stick", "table"), is_not.crowds("computer", "stick"), is.reachable("stick") },
  goal = { any_of { is.in_slot("stick", "computer.left_port"), is.in_slot("stick", "computer.right_port") } },
  instructions = {
    "plug the memory stick into the computer",
    "the USB stick belongs in a port of the computer",
    "insert the stick that lies on the table into the front of the computer",
    "connect the memory stick to the machine",
  },
}
