-- Pull the knife out of the knife block and put it on the chopping board.
return task {
  world = "tabletop",
  objects = { block = { "knife_block" }, board = { "chopping_board" }, knife = { "knife" } },
  init = { is.on("board", "table"), is.on("block", "table"), is.in_slot("knife", "block.slot") },
  goal = { is.on("knife", "board"), is_not.in_slot("knife", "block.slot"), is.hand_empty() },
  instructions = {
    "put the knife on the chopping board",
    "take the knife out of the knife block and lay it on the board",
    "pull the knife from its block and place it on the chopping board",
    "get the knife ready on the wooden board",
  },
}
