-- Open one of the two taps of the basin by a quarter turn; the other one stays shut.
return task {
  variations = { side = { "left", "right" } },
  objects = { basin = { "basin_tap", at = on_table { between(0.10, 0.30), between(-0.20, 0.20) }, yaw = between(-math.pi, math.pi) } },
  init = { is_not.turned("basin.left_tap"), is_not.turned("basin.right_tap") },
  goal = { is.turned("basin.{side}_tap"), stays("others") },
  instructions = function(v) -- the basin may stand any way round: the mark says which side is meant
    local mark = v.side == "left" and "red" or "blue"
    return {
      "turn the " .. v.side .. " tap on, the one with the " .. mark .. " mark",
      "open the tap with the " .. mark .. " mark by a quarter turn",
      "let the " .. (v.side == "left" and "hot" or "cold") .. " water run: its tap bears the " .. mark .. " mark",
      "grip the bar of the " .. v.side .. " tap of the basin, marked " .. mark .. ", and turn it until it is open",
    }
  end,
}
