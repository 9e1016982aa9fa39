-- Take the USB stick out of the computer and put it on the table.
return task {
  objects = {
    computer = { "desktop_computer", at = on_table { between(0.16, 0.24), between(-0.16, 0.16) }, yaw = between(-math.pi, math.pi) },
    stick = { "usb_stick", colour = one_of { "red", "blue", "green", "orange", "magenta" } },
  },
  init = { is.in_slot("stick", "computer.left_port") },
  goal = { is_not.in_slot("stick", "computer.left_port"), is_not.in_slot("stick", "computer.right_port"),
    is.on("stick", "table") },
  instructions = {
    "unplug the memory stick from the computer and lay it down",
    "draw the stick out of its port; it goes on the table",
    "eject the memory stick by hand and put it on the table",
    "the USB stick has done its work: pull it and leave it on the table",
  },
}
