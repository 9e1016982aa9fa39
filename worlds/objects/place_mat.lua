-- A mat for one person who sits at +x: places for a bowl, a fork to its left, a knife and a spoon to its right and a glass
-- behind the knife. Its frame is on the table.
local thick = 0.004 -- m

local function place(x, y, high, folds)
  return { at = { x, y, thick + high / 2 }, rpy = { 0, 0, math.pi }, size = { 0.024, 0.024, high + 0.004 }, traits = { "container", "spot" }, numbers = { folds = folds } }
end

return object {
  type = "board", traits = { "surface" }, fixed = true, colour = { 0.62, 0.30, 0.26 },
  shapes = {
    box { 0.25, 0.38, thick, at = { 0, 0, thick / 2 } },
    box { 0.235, 0.365, 0.0004, at = { 0, 0, thick }, colour = { 0.70, 0.40, 0.34 }, collides = false },
  },
  regions = {
    middle = place(0.03, -0.01, 0.036, 12), left = place(0.045, -0.145, 0.016, 1), right = place(0.045, 0.125, 0.016, 1),
    outline = { at = { 0, 0, 0.02 }, size = { 0.27, 0.40, 0.04 }, traits = { "marked" } }, -- and 1 cm round it
    outer_right = place(0.045, 0.165, 0.016, 1), corner = place(-0.08, 0.09, 0.090, 12),
  },
}
