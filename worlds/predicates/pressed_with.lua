-- The held object has pressed the button or lever to its contact point in this episode: it touched it then, and was in its
-- region `zone`, where it has one.
local function spot_of(w, button) return w:exists(button .. ".spot") and button .. ".spot" or button end

-- Where the spot is when the joint is at `position`.
local function spot_at(w, button, position)
  return w:part_at(button, position):times(w:pose(button):inverse()):times(w:pose(spot_of(w, button)))
end

return predicate {
  params = { "obj: movable", "button: pressable" },
  label = "the {button} has been pressed with the {obj}",
  momentary = true,
  remember = true,
  holds = function(w, obj, button)
    local zone = button .. ".zone"
    return w:joint(button) >= w:number(button, "on_at") and w:grasped(obj) and w:touching(obj, button)
      and (not w:exists(zone) or w:region_distance(zone, obj) <= 0)
  end,
  sample = function(w, obj, button) -- upright, its foremost side where the spot is when it is pressed; the hand behind it
    local _, most = w:joint_range(button)
    local from_x, from_y, from_z = spot_at(w, button, w:joint(button)):position()
    local at = spot_at(w, button, (w:number(button, "on_at") + most) / 2)
    local x, y, z = at:position()
    local way = math.sqrt((x - from_x) ^ 2 + (y - from_y) ^ 2 + (z - from_z) ^ 2)
    local ux, uy, uz = (x - from_x) / way, (y - from_y) / way, (z - from_z) / way
    local long, wide, high = w:size(obj)
    local level = uz ^ 2 < 0.5 -- else its foot presses
    local away = level and math.min(long, wide) / 2 or 0
    local up = w:below(obj) - (level and high - 0.005 or 0)
    local poses, straight = {}, {}
    for turn = 0, 345, 15 do
      local there = pose(x - ux * away, y - uy * away, z + up, 0, 0, math.rad(turn))
      local tip = there:times(w:pose(obj):inverse()):times(w:tip())
      local tx, ty, tz = tip:position()
      local ax, ay, az = tip:along(0, 0, 1):position()
      poses[#poses + 1], straight[there] = there, (ax - tx) * ux + (ay - ty) * uy + (az - tz) * uz
    end
    table.sort(poses, function(a, b) return straight[a] > straight[b] end)
    return poses
  end,
}
