-- The drawer is below another one that would cover it if both were pulled out: no hand gets at it from above then.
local whole = require "worlds.lib.whole"

return predicate {
  params = { "place", "part: openable" },
  label = "the {place} is under the {part}",
  static = true,
  holds = function(w, place, part)
    local drawers = w:has_trait(place, "openable") and w:has_trait(place, "reach_in") and w:has_trait(part, "reach_in")
    if not drawers or place == part or whole(place) ~= whole(part) then return false end
    local from = w:part_at(place, w:number(place, "open_at"))
    local out = w:pose(part):times(w:part_at(part, w:number(part, "open_at")):inverse()) -- from where it would be to where it is
    for step = 1, 40 do
      if w:region_distance(part, out:times(from:offset(0, 0, 0.015 * step))) < 0 then return true end
    end
    return false
  end,
}
