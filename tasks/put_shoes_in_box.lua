-- Put both shoes into the box, which is shut.
return task {
  objects = {
    box = { "lidded_box", at = on_table { between(0.16, 0.26), between(-0.05, 0.05) }, yaw = between(deg(-22), deg(22)) },
    left = { "shoe" }, right = { "shoe" },
  },
  init = { is.closed("box.lid"), is.on("left", "table"), is.on("right", "table"), is.spaced("left", "right"),
    is.outside("left", "box.outline"), is.outside("right", "box.outline") },
  goal = { is.inside("left", "box"), is.inside("right", "box") },
  instructions = {
    "put the shoes in the box",
    "open the box and lay both shoes in it",
    "the pair of shoes goes into the box",
    "pack the two shoes away in the box",
  },
}
