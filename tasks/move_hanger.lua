-- Move the clothes hanger from the one rail to the other.
return task {
  objects = {
    from = { "clothes_rail", at = on_table { between(0.12, 0.26), between(0.14, 0.24) }, yaw = between(math.pi - 0.5, math.pi + 0.5) },
    to = { "clothes_rail", at = on_table { between(0.12, 0.26), between(-0.24, -0.14) }, yaw = between(math.pi - 0.5, math.pi + 0.5) },
    hanger = { "clothes_hanger" },
  },
  init = { is.hanging("hanger", "from.rod") },
  goal = { is.hanging("hanger", "to.rod") },
  instructions = {
    "move the hanger to the other rail",
    "take the clothes hanger off its rail and hang it on the empty one",
    "the hanger belongs on the empty rail",
    "hang the hanger on the rod that bears nothing yet",
  },
}
