-- The hand alone carries the object: it is grasped, nothing else touches it, and it is in no slot and on no hook.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable" },
  label = "the {obj} is lifted",
  settle = 0.1, -- s
  requires = "held",
  margin_unit = "m", -- how deep it could fall, or how far it is out of slots and off hooks where that is less
  holds = function(w, obj)
    local carried, deep = w:carried(obj)
    if not carried then return false, deep end
    local clear = seats.clearance(w, obj)
    return clear > 0, math.min(deep, clear)
  end,
}
