-- A saucepan of steel with a long handle along +x: 16 cm across, 8 cm high; its frame is in the middle of its foot.
local radius, height, wall = 0.080, 0.080, 0.004 -- m

return object {
  type = "pan", traits = { "movable", "support", "stackable" }, colour = { 0.62, 0.64, 0.67 }, mass = 0.9,
  shapes = {
    lathe { { radius, 0.004 }, { radius, height }, wall = wall },
    cylinder { radius, 0.006, at = { 0, 0, 0.003 } },
    box { 0.15, 0.022, 0.012, at = { 0.152, 0, 0.062 }, colour = { 0.12, 0.12, 0.13 } },
  },
  regions = {
    mouth = { at = { 0, 0, height }, size = { 0.15, 0.15, 0.01 } },
    overhead_space = { at = { 0, 0, 0.28 }, size = { 0.16, 0.16, 0.14 }, traits = { "floating", "container" } },
  },
}
