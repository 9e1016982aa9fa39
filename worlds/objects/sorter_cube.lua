-- The cube of the shape sorter, 3.6 cm across.
local quarter = math.pi / 2
return require "worlds.lib.sorter_solids".make("cube", "red", { { 0, 0, 0, 0.036 }, { 0, 0, quarter, 0.036 } })
