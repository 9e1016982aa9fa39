-- A door in its frame, about a third of its real size, that a lever holds shut; it opens towards -x. Its frame is below it, 0.75 m
-- above the floor.
local levers, places = require "worlds.lib.levers", require "worlds.lib.places"
local wood, frame = { 0.86, 0.84, 0.78 }, { 0.55, 0.42, 0.30 }
local width, height, post, thick = 0.34, 0.66, 0.05, 0.024 -- m
local lever_z = 0.36

return object {
  type = "furniture", traits = {}, fixed = true, colour = frame,
  place = places.beside_the_table { gap = 0.06, turn = deg(45), lean = -0.10, wide = 0.44 },
  shapes = {
    box { 0.08, width + 2 * post, 0.75, at = { 0.04, 0, -0.375 }, colour = { 0.75, 0.73, 0.70 } }, -- the wall below
    box { 0.05, post, height, at = { 0.012, width / 2 + post / 2 + 0.002, height / 2 } },
    box { 0.05, post, height, at = { 0.012, -width / 2 - post / 2 - 0.002, height / 2 } },
    box { 0.05, width + 2 * post, post, at = { 0.012, 0, height + post / 2 + 0.002 } },
  },
  parts = {
    door = levers.leaf {
      at = { 0, -width / 2, 0.002 }, width = width, height = height - 0.004, colour = wood, lever = "lever", lever_z = lever_z,
      free = math.rad(25), open = math.rad(25),
      shapes = {
        box { 0.002, width - 0.12, 0.20, at = { -thick - 0.0005, width / 2, 0.52 }, colour = { 0.78, 0.75, 0.68 }, collides = false },
        box { 0.002, width - 0.12, 0.22, at = { -thick - 0.0005, width / 2, 0.17 }, colour = { 0.78, 0.75, 0.68 }, collides = false },
      },
    },
    lever = levers.lever { leaf = "door", width = width, z = lever_z, turn = math.rad(32), most = math.rad(40) },
  },
}
