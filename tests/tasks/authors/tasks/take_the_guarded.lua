-- Stack the rear block on the far one: its guard goes first.
return task {
  world = "tabletop",
  skills = { "wary_pick" },
  objects = {
    guard = { "cube", at = { 0.14, 0, 0.775 } },
    rear = { "cube", at = { 0.23, 0, 0.775 } },
    far = { "cube", at = { 0.20, 0.20, 0.775 } },
  },
  goal = { is.on("rear", "far"), is.hand_empty() },
  instructions = { "stack the rear block on the far one" },
}
