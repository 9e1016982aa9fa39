-- A window with one leaf in a wall; a handle that hangs down holds it shut, and turned level frees it; it opens towards -x. Its frame
-- is below it, 0.75 m above the floor.
local levers, places = require "worlds.lib.levers", require "worlds.lib.places"
local white, wall, glass = { 0.94, 0.94, 0.93 }, { 0.80, 0.76, 0.70 }, { 0.62, 0.76, 0.84 }
local width, height, sill, post, rail = 0.34, 0.40, 0.16, 0.05, 0.035 -- m; sill: its height; rail: of the leaf
local lever_z = 0.24

local leaf = levers.leaf {
  at = { 0, -width / 2, sill + 0.002 }, width = width, height = height - 0.004, colour = white, lever = "lever", hanging = true,
  lever_z = lever_z, free = math.rad(80), open = math.rad(30), type = "window",
  shapes = { box { 0.002, width - 2 * rail, height - 2 * rail, at = { -0.0245, width / 2, height / 2 }, colour = glass, collides = false } },
}

return object {
  type = "furniture", traits = {}, fixed = true, colour = wall,
  place = places.beside_the_table { gap = 0.06, turn = deg(25), lean = 0.14, far = 0.16, wide = 0.44 },
  shapes = {
    box { 0.06, width + 0.30, 0.75 + sill, at = { 0.03, 0, (sill - 0.75) / 2 } },
    box { 0.06, 0.15, height, at = { 0.03, width / 2 + 0.077, sill + height / 2 } },
    box { 0.06, 0.15, height, at = { 0.03, -width / 2 - 0.077, sill + height / 2 } },
    box { 0.06, width + 0.30, 0.10, at = { 0.03, 0, sill + height + 0.052 } },
    box { 0.05, width + 0.10, 0.015, at = { -0.012, 0, sill - 0.010 }, colour = white },
  },
  parts = { leaf = leaf, lever = levers.lever { leaf = "leaf", width = width, z = lever_z, turn = math.rad(86), most = math.rad(92), hanging = true } },
}
