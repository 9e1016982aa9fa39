-- The two are near each other: at most 8 cm from box to box.
local relations = require "worlds.lib.relations"

local most = 0.08 -- m

return predicate {
  params = { "obj: movable", "other" },
  label = "the {obj} is near the {other}",
  settle = 0.1, -- s
  only_named = true,
  made_by = { "place" },
  margin_unit = "m", -- how much further apart they could be
  holds = function(w, obj, other) return relations.near(w, obj, other, most) end,
  sample = function(w, obj, other, rng) return relations.places_near(w, obj, other, most, rng) end,
}
