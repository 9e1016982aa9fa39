-- A red man of the game of checkers.
return require "worlds.lib.checker" ({ 0.80, 0.10, 0.08 })
