-- Put the last piece of the puzzle into its place.
return task {
  objects = { puzzle = { "puzzle_frame" }, piece = { "puzzle_piece" } },
  init = { is.on("puzzle", "table"), is.on("piece", "table"), is_not.crowds("puzzle", "piece") },
  goal = { is.in_slot("piece", "puzzle.hole") },
  instructions = {
    "solve the puzzle",
    "one piece of the puzzle is missing: put it where it fits",
    "set the orange piece into its hole in the puzzle",
    "take the last piece by its grip and complete the picture",
  },
}
