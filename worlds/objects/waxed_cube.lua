-- A cube of 6 cm, smooth with wax: it slides well, and the hand should not touch it.
return object {
  type = "cube", traits = { "movable" }, shape = box { 0.06, 0.06, 0.06 }, mass = 0.12, friction = 0.35,
  colour = { 0.95, 0.93, 0.88 },
}
