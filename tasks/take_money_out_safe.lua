-- Take the stack of banknotes off one shelf of the open safe and put it on the table; the other two stay.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { shelf = { "bottom", "middle", "top" } },
  objects = {
    safe = { "safe", place = places.beside_the_table { gap = 0.17, turn = deg(45), wide = 0.38 } },
    low = { "money" }, mid = { "money" }, high = { "money" },
  },
  init = function(v)
    local stacks = { bottom = "low", middle = "mid", top = "high" }
    return {
      is.inside("low", "safe.bottom_shelf"), is.inside("mid", "safe.middle_shelf"), is.inside("high", "safe.top_shelf"),
      is.reachable(stacks[v.shelf]),
    }
  end,
  goal = function(v)
    local stacks = { bottom = "low", middle = "mid", top = "high" }
    local parts = { is.on(stacks[v.shelf], "table") }
    for shelf, stack in pairs(stacks) do
      if shelf ~= v.shelf then parts[#parts + 1] = is.inside(stack, "safe." .. shelf .. "_shelf") end
    end
    return parts
  end,
  instructions = {
    "fetch the cash from the {shelf} shelf of the safe",
    "move the banknotes on the {shelf} shelf of the safe to the table",
    "withdraw the bundle of notes from the {shelf} shelf and put it on the table",
    "empty the {shelf} shelf of the safe onto the table",
  },
}
