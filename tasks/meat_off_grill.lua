-- Take the chicken or the steak off the grill and put it on the table; the other one stays on the grill.
return task {
  world = "tabletop",
  variations = { meat = { "chicken", "steak" } },
  objects = { grill = { "grill" }, chicken = { "chicken" }, steak = { "steak" } },
  init = { is.on("grill", "table"), is.on("chicken", "grill"), is.on("steak", "grill"),
    is_not.crowds("chicken", "steak"), is_not.crowds("steak", "chicken") },
  goal = function(v)
    local other = v.meat == "steak" and "chicken" or "steak"
    return { is.on(v.meat, "table"), is.on(other, "grill"), is.hand_empty() }
  end,
  instructions = {
    "take the {meat} off the grill",
    "the {meat} is done: put it on the table",
    "move the {meat} from the grate to the table",
    "remove the {meat} from the grill and set it down beside it",
  },
}
