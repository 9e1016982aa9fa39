-- Throw the crumpled paper into the bin; the tomatoes stay on the table.
return task {
  world = "tabletop",
  objects = { bin = { "bin" }, rubbish = { "rubbish" }, tomato = { "tomato", count = 2 } },
  init = { is.on("bin", "table"), is.apart("rubbish", "bin"), is.on("rubbish", "table"),
    is.on("tomato*", "table") },
  goal = { is.inside("rubbish", "bin"), is.on("tomato*", "table"), is.hand_empty() },
  instructions = {
    "put the rubbish in the bin",
    "throw the crumpled paper away",
    "drop the ball of paper into the bin and leave the tomatoes alone",
    "pick up the trash and let it fall into the waste-paper bin",
    "clear the waste paper off the table into the bin",
  },
}
