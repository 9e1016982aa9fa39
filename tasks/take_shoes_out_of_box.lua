-- Take both shoes out of the box, which is shut, and put them on the table.
return task {
  objects = {
    box = { "lidded_box", at = on_table { between(0.16, 0.26), between(-0.05, 0.05) }, yaw = between(deg(-22), deg(22)) },
    left = { "shoe" }, right = { "shoe" },
  },
  init = { is.closed("box.lid"), is.inside("left", "box"), is.inside("right", "box"), is.spaced("left", "right") },
  told = { is.inside("left", "box"), is.inside("right", "box") },
  goal = { is.on("left", "table"), is.on("right", "table") },
  instructions = {
    "take the shoes out of the box",
    "open the box and put both shoes on the table",
    "somebody wants to go out: get the two shoes out of the box",
    "unpack the pair of shoes from the box",
  },
}
