-- A board for chess; its frame is in the middle of its top, and white's side is at -x.
local boards, chess = require "worlds.lib.boards", require "worlds.lib.chess"

return object {
  type = "board", traits = { "movable", "surface", "support" }, mass = 1, friction = 0.6, fixed = true,
  shapes = boards.shapes({ 0.88, 0.78, 0.60 }, { 0.40, 0.24, 0.14 }), regions = chess.regions,
}
