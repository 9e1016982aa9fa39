-- Swing the lid of the box up.
return task {
  objects = { box = { "lidded_box", at = on_table { between(0.12, 0.28), between(-0.20, 0.20) }, yaw = between(deg(-22), deg(22)) } },
  init = { is.closed("box.lid"), is.workable("box.lid") },
  goal = { is.open("box.lid") },
  instructions = {
    "open the box",
    "swing the lid of the box up by its grip",
    "something is to go into the box: lift its lid",
    "let the box stand open",
  },
}
