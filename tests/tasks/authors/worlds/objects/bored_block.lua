-- A heavy block with a square bore of 3 cm, 5 cm deep.
local side, bore, high = 0.10, 0.030, 0.06 -- m
local bar = (side - bore) / 2

return object {
  type = "board", traits = {}, fixed = true, colour = { 0.45, 0.50, 0.58 },
  shapes = {
    box { side, side, 0.01, at = { 0, 0, 0.005 } },
    box { bar, side, high, at = { (bore + bar) / 2, 0, high / 2 } },
    box { bar, side, high, at = { -(bore + bar) / 2, 0, high / 2 } },
    box { bore, bar, high, at = { 0, (bore + bar) / 2, high / 2 } },
    box { bore, bar, high, at = { 0, -(bore + bar) / 2, high / 2 } },
  },
  regions = { bore = { at = { 0, 0, 0.03 }, size = { bore, bore, 0.05 }, traits = { "slot" }, numbers = { gap = 0.006 } } },
}
