-- The star of the shape sorter, of five blunt points.
local holds = {}
for k = 0, 4 do -- one pad on a point, the other on two points beside the notch behind it
  local angle = k * 2 * math.pi / 5
  holds[k + 1] = { 0.002 * math.cos(angle), 0.002 * math.sin(angle), angle + math.pi / 2, 0.046 }
end
return require "worlds.lib.sorter_solids".make("star", "yellow", holds)
