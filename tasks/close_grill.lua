-- Lower the lid of the barbecue, which stands open.
return task {
  objects = { grill = { "barbecue", at = on_table { between(0.14, 0.26), between(-0.18, 0.18) }, yaw = between(deg(-90), deg(90)),
    joints = { lid = between(deg(55), deg(90)) } } },
  init = { is_not.closed("grill.lid"), is.workable("grill.lid") },
  goal = { is.closed("grill.lid") },
  instructions = {
    "close the barbecue",
    "bring the lid of the grill down by its wooden grip",
    "the heat gets out of the grill: shut it",
    "lower the hood of the barbecue",
  },
}
