-- The cylinder of the shape sorter, 4 cm across.
local holds = {}
for k = 0, 7 do holds[k + 1] = { 0, 0, (k + 0.5) * math.pi / 8, 0.0393 } end -- two of its sixteen sides between the fingers
return require "worlds.lib.sorter_solids".make("cylinder", "blue", holds)
