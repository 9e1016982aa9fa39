-- The object hangs on the hook or rod: its loop or hole is around it, and it is held up by it until it leaves it.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable", "hook: hook" },
  label = "the {obj} hangs on the {hook}",
  settle = 0.1, -- s
  margin_unit = "m", -- how far the hook reaches into the loop
  holds = function(w, obj, hook)
    local distance = w:region_distance(hook, seats.loop(w, obj))
    local hangs = distance <= 0 and w:supports(seats.owner(hook), obj)
    return hangs, hangs and -distance or -math.max(distance, 0)
  end,
  sample = function(w, obj, hook) -- in the middle of the hook, or as far down it as its number `down` says
    local there = w:pose(hook):along(0, 0, -w:number(hook, "down", 0))
    if w:number(obj, "swing", 0) > 0 then return seats.all_swinging(w, obj, seats.loop(w, obj), there) end
    return seats.all_with_part_at(w, obj, seats.loop(w, obj), there)
  end,
}
