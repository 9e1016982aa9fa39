-- A rail for clothes: a level rod 32 cm above the table.
return require "worlds.lib.rails" (0.32, 0.16)
