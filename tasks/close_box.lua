-- Shut the lid of the box, which stands open.
return task {
  objects = { box = { "lidded_box", at = on_table { between(0.12, 0.28), between(-0.20, 0.20) }, yaw = between(deg(-22), deg(22)),
    joints = { lid = between(deg(92), deg(108)) } } },
  init = { is_not.closed("box.lid"), is.workable("box.lid") },
  goal = { is.closed("box.lid") },
  instructions = {
    "close the box",
    "bring the lid of the box down until it is shut",
    "the box stands open: shut it",
    "put the lid of the box down again",
  },
}
