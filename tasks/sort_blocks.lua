-- Sort thirty small blocks that lie about into three trays by their colours: sixty skills, one colour after the other.
local function triples()
  local names, list = colours.names, {}
  for i = 1, #names do
    local second = colours.except(names[i]) -- nobody takes one of the three for another
    local b = second[(i + 6) % #second + 1]
    local third = colours.except(names[i], b)
    list[i] = { first = names[i], second = b, third = third[(i + 12) % #third + 1] }
  end
  return list
end

return task {
  world = "tabletop",
  variations = triples(),
  objects = function(v)
    return {
      a = { "sorting_block", colour = v.first, count = 10 },
      b = { "sorting_block", colour = v.second, count = 10 },
      c = { "sorting_block", colour = v.third, count = 10 },
      a_tray = { "tray", colour = v.first, at = { 0.315, -0.25, 0.755 } },
      b_tray = { "tray", colour = v.second, at = { 0.315, 0, 0.755 } },
      c_tray = { "tray", colour = v.third, at = { 0.315, 0.25, 0.755 } },
    }
  end,
  init = { is.on("a*", "table"), is.on("b*", "table"), is.on("c*", "table"),
    is.reachable("a*"), is.reachable("b*"), is.reachable("c*") },
  goal = { is.on("a*", "a_tray"), is.on("b*", "b_tray"), is.on("c*", "c_tray"), is.hand_empty() },
  subgoals = {
    { "first_colour", is.on("a*", "a_tray"), "put the {first} blocks into the {first} tray" },
    { "second_colour", is.on("b*", "b_tray"), "put the {second} blocks into the {second} tray" },
    { "third_colour", is.on("c*", "c_tray"), "put the {third} blocks into the {third} tray" },
  },
  horizon = 900, -- s
  instructions = {
    "sort the blocks into the trays of their colours",
    "put the {first}, {second} and {third} blocks into the trays of the same colours",
    "each block belongs in the tray that looks like it: tidy them all up",
    "clear the table: {first}, {second} and {third} blocks go into their own trays",
  },
}
