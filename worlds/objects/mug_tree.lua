-- A wooden tree for three mugs: its spokes point up by 22 degrees; its frame is below its foot.
local trunk, root, spoke, long, rise = 0.010, 0.215, 0.005, 0.132, math.rad(22) -- m
local middle = 0.092                                                           -- m along the spoke: where a mug hangs

local names = { "first_spoke", "second_spoke", "third_spoke" }

local shapes = {
  cylinder { 0.085, 0.016, at = { 0, 0, 0.008 } },
  cylinder { trunk, root + 0.020, at = { 0, 0, (root + 0.020) / 2 } },
  sphere { 0.014, at = { 0, 0, root + 0.022 } },
}
local regions = {}
for i = 1, #names do
  local around = (i - 1) * 2 * math.pi / #names
  local function at(along, down) -- a place on the spoke, or below it
    local level = along * math.cos(rise) + down * math.sin(rise)
    return { level * math.cos(around), level * math.sin(around), root + along * math.sin(rise) - down * math.cos(rise) }
  end
  local turn = { 0, math.pi / 2 - rise, around }
  shapes[#shapes + 1] = cylinder { spoke, long, at = at(long / 2, 0), rpy = turn }
  shapes[#shapes + 1] = sphere { spoke, at = at(long, 0) }
  shapes[#shapes + 1] = sphere { spoke + 0.003, at = at(middle - 0.026, 0) } -- no mug slides further in
  regions[names[i]] = { -- where the middle of a mug's handle is for as long as it hangs there
    at = at(middle, 0.0065), rpy = turn, size = { 0.04, 0.04, 0.096 }, traits = { "hook" }, numbers = { lift = 0.0065, play = 0.014, askew = deg(35) },
  }
end

return object {
  type = "stand", traits = {}, fixed = true, colour = { 0.62, 0.44, 0.26 }, friction = 0.8,
  shapes = shapes, regions = regions,
}
