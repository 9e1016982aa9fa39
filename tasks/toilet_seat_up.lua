-- Raise the seat of the toilet.
return task {
  objects = { toilet = { "toilet", at = on_table { between(0.16, 0.28), between(-0.18, 0.18) }, yaw = between(deg(-45), deg(45)) } },
  init = { is.closed("toilet.seat") },
  goal = { is.open("toilet.seat") },
  instructions = {
    "put the toilet seat up",
    "swing the seat of the toilet up against the tank",
    "the bowl is to be cleaned: raise the seat",
    "lift the toilet seat by its grip until it stays up",
  },
}
