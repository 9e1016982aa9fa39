-- Sort thirty small blocks that lie about into three trays by their colours: sixty skills, one colour after the other.
return task {
  variations = each(colours.apart(3), function(c) return { first = c[1], second = c[2], third = c[3] } end),
  objects = {
    a = { "sorting_block", colour = "{first}", count = 10 },
    b = { "sorting_block", colour = "{second}", count = 10 },
    c = { "sorting_block", colour = "{third}", count = 10 },
    a_tray = { "tray", colour = "{first}", at = on_table { 0.315, -0.25, 0.005 } },
    b_tray = { "tray", colour = "{second}", at = on_table { 0.315, 0, 0.005 } },
    c_tray = { "tray", colour = "{third}", at = on_table { 0.315, 0.25, 0.005 } },
  },
  init = { is.on("a*", "table"), is.on("b*", "table"), is.on("c*", "table"),
    is.reachable("a*"), is.reachable("b*"), is.reachable("c*") },
  goal = { is.on("a*", "a_tray"), is.on("b*", "b_tray"), is.on("c*", "c_tray") },
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
