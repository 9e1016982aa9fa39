-- Swing the lid of the barbecue up.
return task {
  objects = { grill = { "barbecue", at = on_table { between(0.14, 0.26), between(-0.18, 0.18) }, yaw = between(deg(-90), deg(90)) } },
  init = { is.closed("grill.lid"), is.workable("grill.lid") },
  goal = { is.open("grill.lid") },
  instructions = {
    "open the barbecue",
    "swing the lid of the grill up by its wooden grip",
    "the meat can wait no longer: open the grill",
    "raise the hood of the barbecue",
  },
}
