-- A flat wooden block, too wide for the hand: it can be pushed, not taken.
return object {
  type = "block", traits = { "movable", "support" },
  shape = box { 0.085, 0.085, 0.045 }, mass = 0.2, colour = "red",
}
