-- A king of the game of chess; its frame is 2 cm above its foot.
return object(require "worlds.lib.chess".piece "king")
