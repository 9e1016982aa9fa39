-- Put the stack of banknotes on one of the three shelves of the open safe.
return task {
  world = "tabletop",
  variations = { shelf = { "bottom", "middle", "top" } },
  objects = {
    safe = { "safe", at = { between(0.08, 0.12), between(0.55, 0.58), 0.75 }, yaw = between(1.50, 1.70) },
    money = { "money" },
  },
  init = { is.on("money", "table") },
  goal = function(v) return { is.inside("money", "safe." .. v.shelf), is.hand_empty() } end,
  instructions = {
    "deposit the bundle of money on the {shelf} shelf inside the safe",
    "store the banknotes in the safe, {shelf} shelf",
    "the cash belongs on the {shelf} shelf of the safe: put it away",
    "from the table into the safe with the banknotes, onto its {shelf} shelf",
  },
}
