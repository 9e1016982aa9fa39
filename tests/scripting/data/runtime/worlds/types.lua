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
  numbers = { weight = { "how heavy it looks", default = 0 } },
  traits = {
    movable = "can be carried",
    graspable = "fits between the fingers",
    surface = "things rest on it",
    openable = { "on a joint", numbers = { open_at = { "where it counts as open", unit = "m or rad" } } },
    container = "holds things",
    target = "to be reached",
  },
}
