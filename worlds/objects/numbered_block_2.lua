-- A light cube of 4.5 cm edges with the number 2 on it.
local numbered_block = require "worlds.lib.numbered_block"
return numbered_block(2)
