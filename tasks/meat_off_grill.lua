-- Take the chicken or the steak off the grill and put it on the table; the other one stays on the grill.
return task {
  variations = { meat = { "chicken", "steak" } },
  objects = { grill = { "grill" }, chicken = { "chicken" }, steak = { "steak" } },
  init = { is.on("grill", "table"), is.on("chicken", "grill"), is.on("steak", "grill"),
    is_not.crowds("chicken", "steak"), is_not.crowds("steak", "chicken") },
  goal = { is.on("{meat}", "table"), stays("others") },
  instructions = {
    "move the {meat} from the grate to the table",
    "the {meat} is done: put it on the table",
    "serve the {meat}: from the grill onto the table with it",
    "save the {meat} from the heat and let it rest on the table",
  },
}
