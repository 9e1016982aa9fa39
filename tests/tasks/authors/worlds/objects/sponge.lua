-- A sponge: what it wipes with is the middle of its lower face.
return object {
  type = "sponge", traits = { "movable", "graspable", "tool" }, mass = 0.03, friction = 0.9, colour = { 0.95, 0.80, 0.25 },
  declares = { types = { sponge = { parent = "thing" } } },
  shape = box { 0.09, 0.05, 0.04 },
  tip = { at = { 0, 0, -0.02 }, rpy = { math.pi, 0, 0 } },
}
