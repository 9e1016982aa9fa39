-- Stack two to four blocks of one colour in any order; leave the other colours alone.
return task {
  variations = { height = { 2, 3, 4 }, colour = colours.names },
  objects = {
    block = { "cube", colour = "{colour}", count = 4 },
    other = { "cube", colour = one_of(colours.except("{colour}")), count = 4 },
  },
  init = { is.on("block*", "table"), is.on("other*", "table") },
  goal = function(v) return any_order("block*", v.height, function(b, i) return is.on(b[i], b[i - 1]) end) end,
  horizon = 240, -- s
  instructions = {
    "stack {height} {colour} blocks",
    "build a tower of {height} {colour} cubes",
    "pile up {height} of the blocks that are {colour}",
    "make a pile of {height} {colour} blocks",
  },
}
