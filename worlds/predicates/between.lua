-- The object is between two others, whichever side they are seen from: past the one, before the other, near the line of both.
local relations = require "worlds.lib.relations"

return predicate {
  params = { "obj: movable", "one", "other" },
  label = "the {obj} is between the {one} and the {other}",
  settle = 0.1, -- s
  only_named = true,
  made_by = { "place" },
  margin_unit = "m", -- how far it could go to either of them, or off the line
  holds = function(w, obj, one, other) return relations.between(w, obj, one, other) end,
  sample = function(w, obj, one, other, rng) return relations.places_between(w, obj, one, other, rng) end,
}
