-- Push the door, which stands open, shut until its latch snaps in.
local places = require "worlds.lib.places"

return task {
  objects = { doorway = { "doorway", place = places.beside_the_table { gap = 0.06, turn = deg(45), far = 0.15, wide = 0.44 },
    joints = { door = between(deg(26), deg(60)) } } },
  init = { is_not.closed("doorway.door"), is.workable("doorway.door") },
  goal = { is.closed("doorway.door") },
  instructions = {
    "close the door",
    "push the door shut",
    "there is a draught: shut the door",
    "move the door into its frame until it snaps in",
  },
}
