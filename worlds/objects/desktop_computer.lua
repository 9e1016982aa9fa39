-- A small desktop computer, lying; two ports in its front, which looks along -x.
local dark, grey = { 0.16, 0.17, 0.19 }, { 0.27, 0.28, 0.31 }
local depth, wide, high, port, apart = 0.016, 0.014, 0.006, 0.050, 0.060 -- m: of the ports; their height, their distance
local x = depth / 2
local side = 0.10 - (apart + wide) / 2

return object {
  type = "computer", traits = {}, fixed = true, colour = grey, friction = 0.5,
  shapes = {
    box { 0.15, 0.20, 0.072, at = { depth + 0.075, 0, 0.036 }, colour = dark },
    box { depth, 0.20, 0.072 - port - high / 2, at = { x, 0, 0.036 + port / 2 + high / 4 } },
    box { depth, 0.20, port - high / 2, at = { x, 0, (port - high / 2) / 2 } },
    box { depth, apart - wide, high, at = { x, 0, port } },
    box { depth, side, high, at = { x, 0.10 - side / 2, port } },
    box { depth, side, high, at = { x, side / 2 - 0.10, port } },
    -- looks: vents, a light and a power button
    box { 0.001, 0.12, 0.003, at = { -0.0003, -0.02, 0.014 }, colour = dark, collides = false },
    box { 0.001, 0.12, 0.003, at = { -0.0003, -0.02, 0.021 }, colour = dark, collides = false },
    box { 0.001, 0.12, 0.003, at = { -0.0003, -0.02, 0.028 }, colour = dark, collides = false },
    cylinder { 0.007, 0.002, at = { 0, 0.075, 0.022 }, rpy = { 0, math.pi / 2, 0 }, colour = { 0.2, 0.8, 0.4 }, collides = false },
    box { 0.10, 0.14, 0.001, at = { 0.10, 0, 0.0723 }, colour = grey, collides = false },
  },
  regions = { -- from 5 mm behind the bottom of a port to 1 cm in front of it
    left_port = { at = { x - 0.0025, -apart / 2, port }, rpy = { 0, -math.pi / 2, 0 }, size = { 0.02, 0.03, depth + 0.015 },
      traits = { "slot" }, numbers = { gap = 0.0075, deep = 0.009, askew = deg(9), search = 0.003 } },
    right_port = { at = { x - 0.0025, apart / 2, port }, rpy = { 0, -math.pi / 2, 0 }, size = { 0.02, 0.03, depth + 0.015 },
      traits = { "slot" }, numbers = { gap = 0.0075, deep = 0.009, askew = deg(9), search = 0.003 } },
  },
}
