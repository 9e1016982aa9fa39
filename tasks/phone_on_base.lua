-- Put the phone that lies on the table into its cradle.
return task {
  world = "tabletop",
  objects = { cradle = { "phone_cradle" }, phone = { "phone" } },
  init = { is.on("cradle", "table"), is.on("phone", "table"), is_not.crowds("cradle", "phone") },
  goal = { is.in_slot("phone", "cradle.seat"), is.hand_empty() },
  instructions = {
    "put the phone on its base",
    "hang up the phone",
    "place the phone in the cradle",
    "the phone has to charge: set it on its base",
  },
}
