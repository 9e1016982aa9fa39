-- A fork with four tines.
local head = { box { 0.014, 0.022, 0.005, at = { 0.033, 0, -0.0055 } } }
for k = -1.5, 1.5 do head[#head + 1] = box { 0.040, 0.003, 0.004, at = { 0.060, k * 0.0063, -0.006 } } end

return require "worlds.lib.cutlery" ("cutlery", head)
