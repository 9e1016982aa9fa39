-- Put the one to three checkers that lie beside the board back on squares of their side that lack one.
local boards = require "worlds.lib.boards"
local sides = boards.checkers { x = 0.19, y = 0, z = 0.75 + boards.high }
local lost = { { red = 1, black = 0 }, { red = 1, black = 1 }, { red = 2, black = 1 } }

return task {
  world = "tabletop",
  variations = { count = { 1, 2, 3 } },
  objects = function(v)
    local objects = { board = { "checkers_board", at = sides.at, regions = sides.regions } }
    for colour, missing in pairs(lost[v.count]) do
      objects[colour .. "_man"] = { colour .. "_checker", count = 12 - missing, at = sample_of(sides.squares[colour], 12 - missing) }
      objects["lost_" .. colour] = { colour .. "_checker", count = missing }
    end
    return objects
  end,
  init = { is.on("lost_red*", "table"), is.on("lost_black*", "table") },
  goal = function(v)
    local goal = { is.hand_empty() }
    for colour, missing in pairs(lost[v.count]) do
      for i = 1, missing do
        goal[#goal + 1] = exists("?s: " .. colour .. "_square", is.inside("lost_" .. colour .. i, "?s"))
      end
    end
    return goal
  end,
  also = function(w) return sides.full(w) end, -- no other man has been pushed off its square
  instructions = {
    "complete the board: put what lies beside it back on its squares",
    "set up the game of checkers; {count} of the men still lie on the table",
    "the men beside the board, {count} in number, belong on empty squares of their own side",
    "get the board ready for a game",
  },
}
