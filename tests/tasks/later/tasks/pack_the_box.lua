-- The cube goes into the box, and its lid is shut again.
return task {
  objects = {
    box = { "lidded_box", at = on_table { between(0.16, 0.26), between(-0.05, 0.05) }, yaw = between(deg(-22), deg(22)) },
    item = { "cube", colour = one_of(colours.names) },
  },
  init = { is.closed("box.lid"), is.on("item", "table"), is.outside("item", "box.outline") },
  goal = { is.inside("item", "box"), is.closed("box.lid") },
  instructions = { "put the cube into the box and shut it" },
}
