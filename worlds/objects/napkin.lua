-- A napkin on the table, with cutlery side by side on it. Its frame is on the table.
local thick = 0.005 -- m: folded

local function place(y)
  return { at = { 0, y, thick + 0.008 }, size = { 0.024, 0.024, 0.020 }, traits = { "container", "spot" }, numbers = { folds = 1 } }
end

return object {
  type = "board", traits = { "support" }, fixed = true, colour = { 0.86, 0.88, 0.80 },
  nouns = "serviette",
  shapes = {
    box { 0.20, 0.23, thick, at = { 0, 0, thick / 2 } },
    box { 0.19, 0.012, 0.0004, at = { 0, 0.095, thick }, colour = { 0.40, 0.52, 0.36 }, collides = false },
    box { 0.19, 0.012, 0.0004, at = { 0, -0.095, thick }, colour = { 0.40, 0.52, 0.36 }, collides = false },
  },
  regions = {
    left = place(0.07), middle = place(0), right = place(-0.07),
    outline = { at = { 0, 0, 0.02 }, size = { 0.17, 0.20, 0.04 }, traits = { "marked" } }, -- less what a round thing lacks at its corners
  },
}
