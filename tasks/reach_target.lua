-- Bring the tip of the hand into the target of one colour; two others are there to be ignored.
return task {
  world = "tabletop",
  variations = { colour = colours.names },
  objects = function(v)
    return {
      target = { "ball_target", colour = v.colour, at = { between(0.10, 0.30), between(-0.30, -0.10), between(0.90, 1.15) } },
      left = { "ball_target", colour = one_of(colours.except(v.colour)), at = { between(0.10, 0.30), between(-0.04, 0.04), between(0.90, 1.15) } },
      right = { "ball_target", colour = one_of(colours.except(v.colour)), at = { between(0.10, 0.30), between(0.10, 0.30), between(0.90, 1.15) } },
    }
  end,
  init = { is.hand_empty() },
  goal = { is.at("target") },
  hold = 0.2, -- s
  instructions = {
    "reach the {colour} target",
    "move the tip of the hand to the {colour} ball",
    "touch the {colour} marker with the gripper",
    "go to the {colour} sphere",
  },
}
