-- Hang the picture frame that stands on the table on its hook.
return task {
  objects = {
    hanger = { "frame_hanger", at = on_table { between(0.10, 0.28), between(-0.22, 0.22) }, yaw = between(-math.pi, math.pi) },
    frame = { "picture_frame" },
  },
  init = { is.on("frame", "table") },
  goal = { is.hanging("frame", "hanger.hook") },
  instructions = {
    "hang the framed picture on its hook",
    "the hook is bare: put the picture frame on it",
    "take the picture from the table and hang it up",
    "let the frame hang from the hook by its bar",
  },
}
