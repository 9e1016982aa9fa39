-- Lower the seat of the toilet, which is up.
return task {
  objects = { toilet = { "toilet", at = on_table { between(0.16, 0.28), between(-0.18, 0.18) }, yaw = between(deg(-45), deg(45)), joints = { seat = between(deg(92), deg(99)) } } },
  init = { is.open("toilet.seat") },
  goal = { is.closed("toilet.seat") },
  instructions = {
    "put the toilet seat down",
    "somebody left the seat up: lower it",
    "bring the seat of the toilet down onto the bowl",
    "somebody wants to sit down: fold the seat of the toilet down",
  },
}
