-- A small waste-paper bin for a desk, round and open at the top; its frame is at the middle of its foot.
return object {
  type = "bin", traits = { "movable", "container", "hollow" }, colour = { 0.25, 0.30, 0.38 },
  mass = 0.4, friction = 0.6,
  shapes = {
    cylinder { 0.066, 0.008, at = { 0, 0, 0.004 } },
    lathe { { 0.068, 0 }, { 0.090, 0.158 }, wall = 0.006, segments = 16 },
    lathe { { 0.094, 0.158 }, { 0.094, 0.168 }, wall = 0.012, segments = 16, colour = { 0.12, 0.15, 0.20 } }, -- rim
  },
  regions = { inside = { at = { 0, 0, 0.088 }, size = { 0.13, 0.13, 0.160 } } },
}
