-- Point the remote control at the television and switch that on.
return task {
  objects = { tv = { "television" }, remote = { "remote_control" } },
  init = { is.on("remote", "table"), is.reachable("remote"), is_not.pointing_at("remote", "tv"), is_not.pressed("remote.power_button") },
  goal = in_order { is.pointing_at("remote", "tv"),
    all_of { is.pressed("remote.power_button"), is.pointing_at("remote", "tv") } },
  instructions = {
    "turn the television on with the remote control",
    "point the remote at the television and press its red button",
    "the television is off: aim the remote control at it, then press power",
    "get a picture on the screen by means of the remote",
  },
}
