-- What things are (a tree of types) and what can be done with them (traits).
return {
  types = {
    thing = {},
    fixture = {},
    block = { parent = "thing" },
    cube = { parent = "block" },
    furniture = { parent = "fixture" },
    drawer = { parent = "fixture" },
    button = { parent = "fixture" },
    region = {},
    hand = {},
    colour_name = {},
  },
  traits = {
    movable = "can be carried or pushed",
    graspable = "fits between the fingers",
    support = "other things can rest on it",
    surface = "a level place to put things down",
    stackable = "one thing fits centred on top",
    container = "things can be inside it: a drawer, a box, a marked volume",
    openable = "a drawer, door or lid on a joint",
    pressable = "a button",
    target = "a place for the tip to reach",
    marked = "an area on a surface to push things into",
    floating = "a place in the air to hold something in",
  },
}
