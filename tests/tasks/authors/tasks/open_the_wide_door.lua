-- A door that one grip does not open far enough.
return task {
  world = "tabletop",
  objects = { cabinet = { "wide_door", at = { 0.32, between(-0.05, 0.05), 0.75 }, yaw = between(-0.2, 0.2) } },
  goal = { is.open("cabinet.door"), is.hand_empty() },
  instructions = { "open the cabinet" },
}
