-- The object hangs on the hook or rod: its loop or hole is around it as far down as it goes, and it is held up by it. How
-- far and how straight say the hook's numbers `deep`, `play` and `askew`.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable", "hook: hook" },
  label = "the {obj} hangs on the {hook}",
  settle = 0.1, -- s
  margin_unit = "m",
  holds = function(w, obj, hook)
    local on = seats.seated(w, obj, seats.loop(w, obj), hook, 1, 0.35, true)
    local hangs = on >= 0 and w:supports(seats.owner(hook), obj)
    return hangs, hangs and on or math.min(on, 0)
  end,
  sample = function(w, obj, hook) -- in the middle of the hook, or as far down it as its number `down` says
    local there = w:pose(hook):along(0, 0, -w:number(hook, "down"))
    if w:number(obj, "swing") > 0 then return seats.all_swinging(w, obj, seats.loop(w, obj), there) end
    return seats.all_with_part_at(w, obj, seats.loop(w, obj), there)
  end,
}
