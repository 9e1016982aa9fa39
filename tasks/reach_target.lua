-- Bring the tip of the hand into the target of one colour; two others are there to be ignored.
return task {
  world = "tabletop",
  variations = { colour = colours.names },
  objects = function(v)
    return {
      target = { "floating_target", colour = v.colour, at = { between(0.10, 0.30), between(-0.30, -0.10), between(0.90, 1.15) } },
      left = { "floating_target", colour = one_of(colours.except(v.colour)), at = { between(0.10, 0.30), between(-0.04, 0.04), between(0.90, 1.15) } },
      right = { "floating_target", colour = one_of(colours.except(v.colour)), at = { between(0.10, 0.30), between(0.10, 0.30), between(0.90, 1.15) } },
    }
  end,
  init = { is.hand_empty() },
  goal = { is.at("target") },
  hold = 0.2, -- s
  instructions = {
    "bring the tip of the hand into the {colour} cube",
    "let the fingers meet the {colour} marker in the air",
    "ignore the other markers and go to the {colour} one",
    "hover with the fingertips at the place marked {colour}",
  },
}
