-- Types and traits of the small root that the runtime's tests use.
return {
  types = {
    thing = {},
    fixture = {},
    cube = { parent = "thing" },
    drawer = { parent = "fixture" },
    region = {},
    hand = {},
    colour_name = {},
  },
  traits = {
    movable = "can be carried",
    graspable = "fits between the fingers",
    surface = "things rest on it",
    openable = "on a joint",
    container = "holds things",
    target = "to be reached",
  },
}
