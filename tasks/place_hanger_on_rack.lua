-- Take the clothes hanger out of its low holder and hang it on the rail.
return task {
  objects = {
    holder = { "hanger_holder", at = on_table { between(0.08, 0.26), between(0.14, 0.26) }, yaw = between(math.pi - 0.7, math.pi + 0.7) },
    rack = { "clothes_rail", at = on_table { between(0.14, 0.26), between(-0.24, -0.12) }, yaw = between(math.pi - 0.5, math.pi + 0.5) },
    hanger = { "clothes_hanger" },
  },
  init = { is.hanging("hanger", "holder.rod") },
  goal = { is.hanging("hanger", "rack.rod") },
  instructions = {
    "hang the clothes hanger on the rack",
    "take the hanger out of its holder and put it on the tall rail",
    "the rail has no hanger yet: give it the one from the holder",
    "place the hanger on the rod of the rack",
  },
}
