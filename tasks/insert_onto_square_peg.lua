-- Put the square ring over the peg of one colour; the two other pegs stay bare.
return task {
  variations = { colour = colours.names },
  objects = {
    target = { "square_peg", colour = "{colour}" },
    other = { "square_peg", count = 2, colour = sample_of(colours.except("{colour}"), 2) },
    ring = { "square_ring" },
  },
  init = { is.on("target", "table"), is.on("other*", "table"), is.on("ring", "table"), is_not.crowds("target", "ring"),
    is_not.crowds("other1", "ring"), is_not.crowds("other2", "ring") },
  goal = { is.hanging("ring", "target.peg") },
  instructions = {
    "put the wooden ring over the {colour} peg",
    "the ring belongs on the {colour} peg",
    "lower the square ring onto the peg that is {colour}",
    "let the {colour} peg stick through the ring",
  },
}
