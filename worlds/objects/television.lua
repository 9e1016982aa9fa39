-- A television on a cabinet; its screen faces -x. It shows a test card once a remote control that points at it has had its
-- power button pressed. Its frame is on the cabinet, 0.75 m above the floor.
local places = require "worlds.lib.places"
local black, frame = { 0.03, 0.03, 0.04 }, { 0.12, 0.12, 0.13 }
local width, height, foot = 0.52, 0.30, 0.05 -- m
local front = -0.0185

local function picture(colours)
  local shapes = {}
  for i, colour in ipairs(colours) do
    shapes[i] = box { 0.001, (width - 0.024) / #colours, height - 0.024, colour = colour, collides = false, shows = is.switched_on("self"),
      at = { front, (i - 0.5 - #colours / 2) * (width - 0.024) / #colours, foot + height / 2 } }
  end
  return table.unpack(shapes)
end

return object {
  type = "television", traits = { "aim" }, fixed = true, colour = frame,
  place = places.beside_the_table { gap = 0.16, turn = deg(45), wide = 0.52 },
  shapes = {
    box { 0.20, 0.50, 0.75, at = { 0, 0, -0.375 }, colour = { 0.42, 0.30, 0.20 } },
    box { 0.13, 0.26, 0.008, at = { 0.01, 0, 0.004 } }, box { 0.03, 0.06, foot, at = { 0.01, 0, foot / 2 } },
    box { 0.034, width, height, at = { 0, 0, foot + height / 2 } },
    box { 0.001, width - 0.02, height - 0.02, at = { front + 0.001, 0, foot + height / 2 }, colour = black, collides = false },
    box { 0.001, 0.02, 0.004, at = { front, -width / 2 + 0.03, foot + 0.005 }, colour = { 0.6, 0.1, 0.1 }, collides = false },
    picture { { 0.93, 0.90, 0.35 }, { 0.30, 0.85, 0.85 }, { 0.30, 0.80, 0.35 }, { 0.80, 0.35, 0.75 }, { 0.85, 0.25, 0.22 }, { 0.25, 0.30, 0.80 } },
  },
}
