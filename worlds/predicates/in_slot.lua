-- The object is in the slot, socket, port or tube: the end that goes in has not left it.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable", "slot: slot" },
  label = "the {obj} is in the {slot}",
  settle = 0.1, -- s
  margin_unit = "m",
  holds = function(w, obj, slot)
    local distance = w:region_distance(slot, seats.seat(w, obj))
    return distance <= 0, -distance
  end,
  sample = function(w, obj, slot) -- all the way in, but for the slot's `gap`
    local _, _, depth = w:size(slot)
    local bottom = w:pose(slot):along(0, 0, w:number(slot, "gap", 0.001) - depth / 2)
    return seats.all_with_part_at(w, obj, seats.seat(w, obj), bottom)
  end,
}
