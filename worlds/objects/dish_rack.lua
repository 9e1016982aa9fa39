-- A dish rack with three slots for plates that stand on edge: black, red and purple posts.
local racks = require "worlds.lib.dish_racks"

return object(racks { { "black_slot", "black" }, { "red_slot", "red" }, { "purple_slot", "purple" } })
