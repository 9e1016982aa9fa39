-- A thing to be carried that weighs nothing.
return object {
  type = "cube", traits = { "movable", "graspable" },
  shape = box { 0.04, 0.04, 0.04 }, mass = 0,
}
