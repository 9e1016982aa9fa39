-- Put the stack of banknotes on one of the three shelves of the open safe.
return task {
  variations = { shelf = { "bottom", "middle", "top" } },
  objects = { safe = { "safe" }, money = { "money" } },
  init = { is.on("money", "table") },
  goal = is.inside("money", "safe.{shelf}_shelf"),
  instructions = {
    "deposit the bundle of money on the {shelf} shelf inside the safe",
    "store the banknotes in the safe, {shelf} shelf",
    "the cash belongs on the {shelf} shelf of the safe: put it away",
    "take the banknotes from the table and lay them on the {shelf} shelf of the safe",
  },
}
