-- Find the block that lies in one of three closed drawers, and put it on the table; no sentence says in which.
-- The demonstrator knows: it opens the right drawer at once. What can be seen (`observed_facts`) differs until then.
return task {
  world = "tabletop",
  variations = { hidden_in = { "bottom", "middle", "top" } },
  objects = {
    chest = { "chest", at = { between(0.52, 0.55), between(0.12, 0.16), 0.75 } },
    item = { "cube", colour = one_of(colours.names) },
  },
  init = function(v)
    return { is.inside("item", "chest." .. v.hidden_in .. "_drawer"),
      is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer") }
  end,
  goal = { is.on("item", "table"), is.hand_empty() },
  instructions = {
    "find the block in the chest and put it on the table",
    "a block is in one of the drawers: bring it to the table",
    "look for the cube in the chest of drawers, take it out and set it down on the table",
    "get the hidden block out of its drawer and place it on the table",
  },
}
