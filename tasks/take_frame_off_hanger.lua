-- Take the picture frame off the hook and put it on the table.
return task {
  world = "tabletop",
  objects = {
    hanger = { "frame_hanger", at = { between(0.10, 0.28), between(-0.22, 0.22), 0.75 }, yaw = between(-math.pi, math.pi) },
    frame = { "picture_frame" },
  },
  init = { is.hanging("frame", "hanger.hook") },
  goal = { is_not.hanging("frame", "hanger.hook"), is.on("frame", "table"), is.hand_empty() },
  instructions = {
    "take the picture off the hanger and put it on the table",
    "take down the frame and set it on the table",
    "unhook the picture frame and leave it on the table",
    "remove the picture from its hook and place it on the table",
  },
}
