-- Fill the cup that stands on the table with ice: push the lever in the fridge's niche back with it, and keep it in the hand.
return task {
  objects = {
    fridge = { "ice_fridge" },
    cup = { "tumbler", colour = one_of(colours.names) },
  },
  init = { is.on("cup", "table"), is_not.pressed("fridge.lever") },
  goal = { is.pressed_with("cup", "fridge.lever"), is.holding("cup"), is.lifted("cup") },
  instructions = {
    "get ice from the fridge into the cup",
    "hold the cup against the lever of the fridge until ice comes",
    "the drink needs ice: push the lever in the front of the fridge back with the cup",
    "press the lever in the niche of the fridge with the cup, and keep hold of it",
  },
}
