-- The object is seated in the slot, socket, port or tube: all the way in, and straight. How deep and how straight say the
-- slot's numbers `deep` (else 4 mm above where `gap` puts it), `askew` and `play`.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable", "slot: slot" },
  label = "the {obj} is in the {slot}",
  settle = 0.1, -- s
  margin_unit = "m",
  holds = function(w, obj, slot)
    local seated = seats.seated(w, obj, seats.seat(w, obj), slot, w:number(slot, "gap") + 0.004, 0.2,
      w:number(obj, "ends") == 2)
    return seated >= 0, seated
  end,
  sample = function(w, obj, slot) -- all the way in, but for the slot's `gap`
    local _, _, depth = w:size(slot)
    local bottom = w:pose(slot):along(0, 0, w:number(slot, "gap") - depth / 2)
    return seats.all_with_part_at(w, obj, seats.seat(w, obj), bottom)
  end,
}
