-- A piece of wall with a socket for two square pins, standing on the table; its front looks along -x.
local wall = { 0.86, 0.84, 0.78 }
local depth, hole, pitch = 0.024, 0.0075, 0.020 -- m: of the holes, their width, and from one to the other
local x = 0.012                                  -- the middle of the holes; the front is at x = 0
local z = 0.13                                   -- their height

return object {
  type = "outlet", traits = {}, fixed = true, colour = { 0.97, 0.97, 0.95 }, friction = 0.6,
  shapes = {
    box { 0.030, 0.30, 0.094, at = { 0.019, 0, 0.047 }, colour = wall },                                  -- below
    box { 0.030, 0.30, 0.010, at = { 0.019, 0, 0.171 }, colour = wall },                                  -- above
    box { 0.030, 0.114, 0.072, at = { 0.019, 0.093, z }, colour = wall },
    box { 0.030, 0.114, 0.072, at = { 0.019, -0.093, z }, colour = wall },
    box { 0.012, 0.30, 0.176, at = { 0.040, 0, 0.088 }, colour = { 0.70, 0.67, 0.60 } },                    -- behind
    box { 0.10, 0.30, 0.012, at = { 0.060, 0, 0.006 }, colour = { 0.70, 0.67, 0.60 } },                   -- foot
    -- the plate, of five bars that leave two holes
    box { depth, 0.072, (0.072 - hole) / 2, at = { x, 0, z + (0.072 + hole) / 4 } },
    box { depth, 0.072, (0.072 - hole) / 2, at = { x, 0, z - (0.072 + hole) / 4 } },
    box { depth, pitch - hole, hole, at = { x, 0, z } },
    box { depth, 0.036 - (pitch + hole) / 2, hole, at = { x, 0.018 + (pitch + hole) / 4, z } },
    box { depth, 0.036 - (pitch + hole) / 2, hole, at = { x, -0.018 - (pitch + hole) / 4, z } },
  },
  regions = { -- from the bottom of the holes to 2 cm in front of the plate
    socket = {
      at = { x - 0.010, 0, z }, rpy = { 0, -math.pi / 2, 0 }, size = { 0.03, 0.05, depth + 0.020 },
      traits = { "slot" }, numbers = { gap = 0.0045, deep = 0.0065, askew = deg(6), search = 0.003 },
    },
  },
}
