-- Put the stack of banknotes on one of the three shelves of the open safe.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { shelf = { "bottom", "middle", "top" } },
  objects = {
    safe = { "safe", place = places.beside_the_table { gap = 0.17, turn = deg(45), wide = 0.38 } },
    money = { "money" },
  },
  init = { is.on("money", "table") },
  goal = function(v) return { is.inside("money", "safe." .. v.shelf .. "_shelf") } end,
  instructions = {
    "deposit the bundle of money on the {shelf} shelf inside the safe",
    "store the banknotes in the safe, {shelf} shelf",
    "the cash belongs on the {shelf} shelf of the safe: put it away",
    "take the banknotes from the table and lay them on the {shelf} shelf of the safe",
  },
}
