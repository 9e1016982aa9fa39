-- Throw the crumpled paper into the bin; the tomatoes stay on the table.
return task {
  objects = { bin = { "bin" }, rubbish = { "rubbish" }, tomato = { "tomato", count = 2 } },
  init = { is.on("bin", "table"), is.apart("rubbish", "bin"), is.on("rubbish", "table"),
    is.on("tomato*", "table") },
  goal = { is.inside("rubbish", "bin"), stays("others") },
  instructions = {
    "clear the waste paper off the table into the bin",
    "the crumpled paper is rubbish: get rid of it",
    "drop the ball of paper into the bin and spare the tomatoes",
    "bin the paper; the tomatoes are still good",
  },
}
