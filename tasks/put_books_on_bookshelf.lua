-- Put one, two or all three books that stand on the table on the shelf beside it; the others stay where they are.
---@type string[]
local names = { "red_book", "green_book", "blue_book" }
local words = { "red book", "red book and the green one", "red, the green and the blue book" }

return task {
  variations = { count = { 1, 2, 3 } },
  objects = {
    bookshelf = { "bookshelf" },
    red_book = { "book", colour = "red" }, green_book = { "book", colour = "green" }, blue_book = { "book", colour = "blue" },
  },
  init = { is.on("red_book", "table"), is.apart("green_book", "red_book"), is.on("green_book", "table"),
    is.apart("blue_book", "red_book"), is.apart("blue_book", "green_book"), is.on("blue_book", "table"),
    is.reachable("red_book"), is.reachable("green_book"), is.reachable("blue_book") },
  goal = function(v)
    local parts = { stays("others") }
    for i = 1, v.count do parts[#parts + 1] = is.inside(names[i], "bookshelf.shelf") end
    return parts
  end,
  instructions = function(v)
    local what = words[v.count]
    return { "put the " .. what .. " on the bookshelf", "the " .. what .. " must go back to the bookshelf",
      "clear the " .. what .. " off the table and onto the shelf", "shelve the " .. what }
  end,
}
