-- The other thing stands where a hand would be that takes the object from above across its shorter side. The object's
-- number `grip` says how far along +x from its middle it is taken, `behind` how far a hand that leans reaches over -x.
local finger, palm = 0.05, 0.10 -- m to either side: the middle of an open finger, the end of the palm
local below_palm = 0.03 -- m: the palm stays this far above the middle of what the hand takes

-- The distance of a point of the object's plan from the other thing's box (wherever its frame is in it), seen from above.
local function gap(w, other, obj, x, y)
  local px, py = w:pose(obj):along(x, y, 0):position()
  return w:region_distance(other, px, py, (w:bottom(other) + w:top(other)) / 2)
end

return predicate {
  params = { "other", "obj: movable" },
  label = "the {other} leaves no room for a hand around the {obj}",
  start_only = true,
  margin_unit = "m", -- how much more room there would have to be
  holds = function(w, other, obj)
    if other == obj then return false end
    local length, width = w:size(obj)
    local tall = w:top(other) > (w:bottom(obj) + w:top(obj)) / 2 + below_palm
    local room, grip, behind = 1.0, w:number(obj, "grip"), w:number(obj, "behind")
    for _, out in ipairs(tall and { -palm, -finger, finger, palm } or { -finger, finger }) do
      local x, y = 0, out
      if length < width then x, y = out, 0 end
      room = math.min(room, gap(w, other, obj, x + grip, y) - (tall and 0.04 or 0.022))
    end
    if tall and behind > 0 then
      for _, y in ipairs { -palm, 0, palm } do room = math.min(room, gap(w, other, obj, grip - behind, y) - 0.04) end
    end
    return room < 0, -room
  end,
}
