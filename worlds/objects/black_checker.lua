-- A black man of the game of checkers.
return require "worlds.lib.checker" ({ 0.10, 0.10, 0.11 })
