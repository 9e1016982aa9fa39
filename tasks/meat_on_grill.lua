-- Put the chicken or the steak on the grill; the other one stays where it is.
return task {
  world = "tabletop",
  variations = { meat = { "chicken", "steak" } },
  objects = { grill = { "grill" }, chicken = { "chicken" }, steak = { "steak" } },
  init = { is.on("grill", "table"), is.on("chicken", "table"), is.on("steak", "table"),
    is_not.crowds("grill", "chicken"), is_not.crowds("grill", "steak"),
    is_not.crowds("chicken", "steak"), is_not.crowds("steak", "chicken") },
  goal = function(v) return { is.on(v.meat, "grill"), is.hand_empty() } end,
  instructions = {
    "put the {meat} on the grill",
    "grill the {meat}",
    "pick up the {meat} and lay it on the grate",
    "the {meat} is to be cooked: place it on the grill and leave the other meat where it is",
  },
}
