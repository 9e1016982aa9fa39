-- Take the stack of banknotes off one shelf of the open safe and put it on the table; the other two stay.
local stacks = { bottom = "low", middle = "mid", top = "high" }

return task {
  variations = { shelf = { "bottom", "middle", "top" } },
  objects = {
    safe = { "safe" },
    low = { "money" }, mid = { "money" }, high = { "money" },
  },
  init = function(v)
    return { is.inside("low", "safe.bottom_shelf"), is.inside("mid", "safe.middle_shelf"), is.inside("high", "safe.top_shelf"),
      is.reachable(stacks[v.shelf]) }
  end,
  goal = function(v) return { is.on(stacks[v.shelf], "table"), stays("others") } end,
  instructions = {
    "fetch the cash from the {shelf} shelf of the safe",
    "move the banknotes on the {shelf} shelf of the safe to the table",
    "withdraw the bundle of notes from the {shelf} shelf and put it on the table",
    "empty the {shelf} shelf of the safe onto the table",
  },
}
