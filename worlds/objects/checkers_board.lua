-- A board for checkers; its frame is in the middle of its top, and red's side is at -x, black's at +x.
local boards = require "worlds.lib.boards"

return object {
  type = "board", traits = { "movable", "surface", "support" }, mass = 1, friction = 0.6, fixed = true,
  shapes = boards.shapes({ 0.90, 0.80, 0.62 }, { 0.36, 0.22, 0.12 }), regions = boards.checkers.regions,
}
