-- A square peg of 4.4 cm, 9 cm high, on a heavy foot; rings with a square hole go over it.
return object {
  type = "peg", traits = { "movable" }, mass = 2, friction = 0.5, colour = "red",
  shapes = {
    box { 0.13, 0.13, 0.016, at = { 0, 0, 0.008 }, colour = { 0.55, 0.40, 0.26 } },
    box { 0.044, 0.044, 0.074, at = { 0, 0, 0.053 } },
  },
  regions = { -- where the middle of the hole is for as long as the peg is in it
    peg = { at = { 0, 0, 0.0535 }, size = { 0.02, 0.02, 0.075 }, traits = { "hook" }, numbers = { lift = 0.002, down = 0.0255, deep = 0.013, askew = deg(4) } },
  },
  numbers = { room = 0.16 },
}
