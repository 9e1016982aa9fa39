-- Bring the tip of the hand into the target of one colour; two others are there to be ignored.
local anywhere = { between(0.06, 0.34), between(-0.32, 0.32), between(0.86, 1.18) } -- m

return task {
  variations = { colour = colours.names },
  objects = {
    target = { "floating_target", colour = "{colour}", at = anywhere },
    other = { "floating_target", count = 2, colour = one_of(colours.except("{colour}")), at = anywhere },
  },
  init = { is.hand_empty(), is.pairwise("spaced", "target", "other*") },
  goal = { is.at("target") },
  hold = 0.2, -- s
  instructions = {
    "bring the tip of the hand into the {colour} cube",
    "let the fingers meet the {colour} marker in the air",
    "ignore the other markers and go to the {colour} one",
    "hover with the fingertips at the place marked {colour}",
  },
}
