-- Put two cups into the one of the colour that is named, which stays where it is.
return task {
  variations = { colour = colours.names },
  objects = {
    base = { "stacking_cup", colour = "{colour}" },
    cup = { "stacking_cup", count = 2, colour = sample_of(colours.except("{colour}"), 2) },
  },
  init = { is.on("base", "table"), is.on("cup*", "table") },
  goal = { is.on("base", "table"), any_of {
    all_of { is.on("cup1", "base"), is.on("cup2", "cup1") }, all_of { is.on("cup2", "base"), is.on("cup1", "cup2") } } },
  also = function(w) -- in each other, not on the rim
    local low, high = w:bottom("cup1"), w:bottom("cup2")
    if low > high then low, high = high, low end
    local foot, deep = w:bottom("base"), 0.046 -- m: from foot to foot, and 5 mm
    return low - foot < deep and high - low < deep
  end,
  instructions = {
    "put the other cups into the {colour} one",
    "nest all three cups, the {colour} one outermost",
    "two cups belong in the {colour} cup: stack them there",
    "make one stack of the cups; the {colour} cup does not move",
  },
}
