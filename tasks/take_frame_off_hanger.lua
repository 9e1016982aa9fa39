-- Take the picture frame off the hook and put it on the table.
return task {
  objects = {
    hanger = { "frame_hanger", at = on_table { between(0.10, 0.28), between(-0.22, 0.22) }, yaw = between(-math.pi, math.pi) },
    frame = { "picture_frame" },
  },
  init = { is.hanging("frame", "hanger.hook") },
  goal = { is_not.hanging("frame", "hanger.hook"), is.on("frame", "table") },
  instructions = {
    "unhook the picture frame and leave it on the table",
    "lift the framed picture from its hook and set it down",
    "the picture has hung long enough: stand it on the table",
    "free the frame from the hook; the table is where it goes",
  },
}
