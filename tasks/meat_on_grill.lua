-- Put the chicken or the steak on the grill; the other one stays where it is.
return task {
  variations = { meat = { "chicken", "steak" } },
  objects = { grill = { "grill" }, chicken = { "chicken" }, steak = { "steak" } },
  init = { is.on("grill", "table"), is.on("chicken", "table"), is.on("steak", "table"),
    is_not.crowds("grill", "chicken"), is_not.crowds("grill", "steak"),
    is_not.crowds("chicken", "steak"), is_not.crowds("steak", "chicken") },
  goal = { is.on("{meat}", "grill"), stays("others") },
  instructions = {
    "lay the {meat} across the bars of the grate",
    "start cooking the {meat} and leave the other meat where it is",
    "the {meat} is still raw: it belongs on the grate",
    "of the two pieces of meat only the {meat} goes onto the grill",
  },
}
