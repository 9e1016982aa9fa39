-- Put the knife that lies on the chopping board into the slot of the knife block.
return task {
  objects = { block = { "knife_block" }, board = { "chopping_board" }, knife = { "knife" } },
  init = { is.on("board", "table"), is.on("block", "table"), is.on("knife", "board"),
    is_not.crowds("block", "knife") },
  goal = { is.in_slot("knife", "block.slot") },
  instructions = {
    "put the knife away in its block",
    "slide the blade of the kitchen knife into the wooden block",
    "the chopping is done: the knife goes back into the knife block",
    "take the knife off the board and push it into the slot of its block",
  },
}
