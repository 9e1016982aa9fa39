-- Put the phone that lies on the table into its cradle.
return task {
  objects = { cradle = { "phone_cradle" }, phone = { "phone" } },
  init = { is.on("cradle", "table"), is.on("phone", "table"), is_not.crowds("cradle", "phone") },
  goal = { is.in_slot("phone", "cradle.seat") },
  instructions = {
    "return the handset to its charging cradle",
    "the phone has to charge: set it in its cradle",
    "dock the blue phone",
    "seat the phone in the cradle that stands on the table",
  },
}
