-- Blocks of one colour on the bench, with a chest and a place in the air.
return task {
  world = "bench",
  variations = { height = { 2, 3 }, colour = { "red", "blue" } },
  objects = function(v)
    return {
      block = { "cube", colour = v.colour, count = v.height },
      other = { "cube", colour = one_of(colours.except(v.colour)), count = 20 },
      pair = { "cube", colour = sample_of({ "red", "green", "blue" }, 2), count = 2, attributes = { rank = "low" } },
      chest = { "chest", at = { between(0.2, 0.4), -0.3, 0.5 }, yaw = between(-1, 1), joints = { drawer = 0.05 } },
      spot = { "spot" },
      none = { "cube", count = 0 },
    }
  end,
  init = { is.on("block*", "bench"), is.on("other*", "bench"), is.on("pair*", "bench"), is.inside("spot", "corner"),
    is.hand_empty(), is_not.holding("pair*") },
  goal = function(v)
    return all_of { any_order("block*", v.height, function(b, i) return is.on(b[i], b[i - 1]) end), is.hand_empty() }
  end,
  subgoals = {
    zebra = is.holding("block1"),
    ape = is.on("block2", "block1"),
  },
  fails = function(w, v) return w:time() > 100 * v.height end,
  reward = function(w, v) return v.height / 4 end,
  hold = function(v) return v.height / 2 end,
  horizon = 33,
  instructions = { "stack {height} {colour} blocks", "a tower of {height}" },
}
