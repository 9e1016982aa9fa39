-- The object is in the hand, touches nothing that could hold it up, and is in no slot and on no hook.
local seats = require "worlds.lib.seats"

return predicate {
  params = { "obj: movable" },
  label = "the {obj} is lifted",
  settle = 0.1, -- s
  requires = "held",
  holds = function(w, obj)
    if not w:grasped(obj) then return false end
    for _, other in ipairs(w:objects("support")) do
      if other ~= obj and w:touching(other, obj) then return false end
    end
    return seats.clearance(w, obj) > 0
  end,
}
