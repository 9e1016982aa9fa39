-- Pull the knife out of the knife block and put it on the chopping board.
return task {
  objects = { block = { "knife_block" }, board = { "chopping_board" }, knife = { "knife" } },
  init = { is.on("board", "table"), is.on("block", "table"), is.in_slot("knife", "block.slot") },
  goal = { is.on("knife", "board"), is_not.in_slot("knife", "block.slot") },
  instructions = {
    "draw the knife from its block and rest it on the chopping board",
    "get the knife ready on the wooden board",
    "the knife is needed on the board: bring it there from the knife block",
    "lay the kitchen knife flat on the board for chopping",
  },
}
