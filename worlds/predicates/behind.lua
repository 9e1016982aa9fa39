-- The door, lid or drawer must be open for the hand to get at the place: shut, it is in the way out (out of a shelf or drawer
-- straight forwards, out of another container or slot straight up), or the place is in the drawer.
local whole = require "worlds.lib.whole"

local function forwards(w, place) return w:has_trait(place, "shelf") or w:has_trait(place, "openable") end

return predicate {
  params = { "place", "part: openable" },
  label = "the {place} is behind the {part}",
  static = true,
  holds = function(w, place, part)
    if whole(place) ~= whole(part) then return false end
    if string.sub(place, 1, #part + 1) == part .. "." then return true end
    if place == part or not (w:has_trait(place, "container") or w:has_trait(place, "slot") or w:has_trait(place, "openable")) then return false end
    local region = w:exists(place .. ".inside") and place .. ".inside" or place
    local from = w:has_trait(place, "openable") and w:part_at(place, w:number(place, "closed_at")) or w:pose(region)
    local shut = w:pose(part):times(w:part_at(part, w:number(part, "closed_at")):inverse()) -- from its place to where it is now
    for step = 1, 40 do
      local way = 0.015 * step -- m
      local out = forwards(w, place) and from:along(-way, 0, 0) or from:offset(0, 0, way)
      if w:region_distance(part, shut:times(out)) < 0 then return true end
    end
    return false
  end,
}
