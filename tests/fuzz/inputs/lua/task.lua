return task {
  world = "bench",
  variations = { height = { 2, 3 }, colour = colours.names },
  objects = function(v)
    return {
      block = { "cube", colour = v.colour, count = v.height },
      other = { "cube", colour = one_of(colours.except(v.colour)), count = 2 },
      chest = { "chest", at = { between(0.2, 0.4), -0.3, 0.5 }, yaw = between(-1, 1), joints = { drawer = 0.05 } },
    }
  end,
  init = { is.on("block*", "bench"), is_not.holding("other*") },
  goal = function(v)
    return all_of { any_order("block*", v.height, function(b, i) return is.on(b[i], b[i - 1]) end), is.hand_empty() }
  end,
  subgoals = { first = is.holding("block1") },
  fails = function(w, v) return w:time() > 100 * v.height end,
  horizon = 33,
  instructions = { "stack {height} {colour} blocks" },
}
