-- A stand that holds one plate on edge.
local racks = require "worlds.lib.dish_racks"

return object(racks { { "slot", "silver" } })
