-- Pick up the cup of one colour; a cup of another colour stays where it is.
return task {
  variations = { colour = colours.names },
  objects = {
    cup = { "cup", colour = "{colour}" },
    other = { "cup", colour = one_of(colours.except("{colour}")) },
  },
  init = { is.on("cup", "table"), is.on("other", "table"), is.apart("cup", "other") },
  goal = { is.holding("cup"), is.lifted("cup") },
  also = function(w) return w:bottom("cup") > w:top("table") + 0.05 end, -- m: clear of where it stood
  instructions = {
    "take hold of the {colour} cup and keep it off the table",
    "hold the {colour} cup clear of the table",
    "raise the cup that is {colour}",
    "of the two cups get the {colour} one into your hand and up",
  },
}
