-- Find the tin that lies in one of three closed drawers, and put it on the table; no sentence says in which.
-- Nobody knows: drawers are opened, in a drawn order, until the tin is seen. What is known by then: `observed_facts`.
return task {
  variations = { hidden_in = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest" },
    item = { "tin", colour = one_of(colours.names) },
  },
  init = { is.inside("item", "chest.{hidden_in}_drawer"),
    is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer") },
  goal = { is.on("item", "table") },
  instructions = {
    "find the tin in the chest and put it on the table",
    "a tin is in one of the drawers: bring it to the table",
    "look for the tin in the chest of drawers, take it out and set it down on the table",
    "get the hidden tin out of its drawer and place it on the table",
  },
}
