-- Open one of the two taps of the basin by a quarter turn; the other one stays shut.
return task {
  world = "tabletop",
  variations = { side = { "left", "right" } },
  objects = { basin = { "basin_tap", at = { between(0.10, 0.30), between(-0.20, 0.20), 0.75 }, yaw = between(-math.pi, math.pi) } },
  init = { is_not.turned("basin.left_tap"), is_not.turned("basin.right_tap") },
  goal = function(v)
    return { is.turned("basin." .. v.side .. "_tap"), is_not.turned("basin." .. (v.side == "left" and "right" or "left") .. "_tap"),
      is.hand_empty() }
  end,
  instructions = {
    "turn the {side} tap on",
    "open the {side} tap of the basin by a quarter turn",
    "let the water run from the {side} tap",
    "grip the bar of the {side} tap and turn it until it is open",
  },
}
