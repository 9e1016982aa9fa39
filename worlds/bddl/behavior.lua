-- BEHAVIOR's words (synsets), beside those that are built in.
return {
  dialect = "behavior",
  extend = true,
  categories = {
    { "cube.n.05", "cube" },
  },
  room = "kitchen", -- where scene objects stand, unless `rooms` says otherwise
  rooms = { push_button = "living_room" },
}
