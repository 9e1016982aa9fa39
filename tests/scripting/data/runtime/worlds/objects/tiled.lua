-- A tiled block.
return object {
  type = "cube", traits = { "movable" }, shape = box { 0.04, 0.04, 0.04 }, mass = 0.1,
  texture = texture { "tiles.png", size = 0.02 },
}
