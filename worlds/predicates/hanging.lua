-- The object hangs on the hook or rod: its loop or hole is around it and it is held up by it, not by a hand.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable", "hook: hook" },
  label = "the {obj} hangs on the {hook}",
  settle = 0.1, -- s
  holds = function(w, obj, hook)
    return w:region_distance(hook, seats.loop(w, obj)) <= 0 and w:supports(seats.owner(hook), obj)
  end,
  sample = function(w, obj, hook) return seats.with_part_at(w, obj, seats.loop(w, obj), w:pose(hook)) end,
}
