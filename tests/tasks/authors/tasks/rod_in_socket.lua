-- The rod goes into a hole that somebody takes to be 4 mm beside where it is.
return task {
  world = "tabletop",
  variations = { hole = { "searched", "plain" } },
  objects = {
    socket = { "rod_socket", at = { 0.25, 0.10, 0.75 } },
    rod = { "rod", at = { 0.20, -0.15, 0.75 } },
  },
  goal = function(v) return { is.in_slot("rod", "socket." .. v.hole), is.hand_empty() } end,
  steps = function(v)
    local x = 0.25 + (v.hole == "searched" and 0.055 or -0.055)
    return {
      act.pick("rod", "table"),
      act.insert("rod", "socket." .. v.hole, { spot = { x + 0.004, 0.10, 0.75 + 0.011, 0, 0, 0, 1 } }),
    }
  end,
  instructions = { "put the rod into the hole" },
}
