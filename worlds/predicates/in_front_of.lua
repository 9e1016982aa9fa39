-- The object is in front of the other, for somebody who stands opposite the robot and looks at it: towards +x of its base.
local relations = require "worlds.lib.relations"

return predicate {
  params = { "obj: movable", "other" },
  label = "the {obj} is in front of the {other}",
  settle = 0.1, -- s
  only_named = true,
  made_by = { "place" },
  margin_unit = "m", -- how far it could go back, or to either hand
  holds = function(w, obj, other) return relations.beside(w, "in_front_of", obj, other) end,
  sample = function(w, obj, other, rng) return relations.places_beside(w, "in_front_of", obj, other, rng) end,
}
