-- Point the remote control at the television and go one channel up or down.
return task {
  variations = { channel = { "next", "previous" } },
  objects = { tv = { "television" }, remote = { "remote_control" } },
  init = { is.on("remote", "table"), is.reachable("remote"), is_not.pointing_at("remote", "tv"),
    is_not.pressed("remote.plus_button"), is_not.pressed("remote.minus_button") },
  goal = function(v)
    local button, other = "remote.plus_button", "remote.minus_button"
    if v.channel == "previous" then button, other = other, button end
    return in_order { is.pointing_at("remote", "tv"),
      all_of { is.pressed(button), is_not.pressed(other), is.pointing_at("remote", "tv") } }
  end,
  instructions = function(v)
    local sign, way = v.channel == "next" and "plus" or "minus", v.channel == "next" and "up" or "down"
    return {
      "switch the television to the {channel} channel",
      "point the remote at the television and press the " .. sign .. " button",
      "go one channel " .. way .. " with the remote control",
      "aim the remote control at the screen, then change to the {channel} channel",
    }
  end,
}
