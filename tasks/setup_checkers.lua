-- Put the one to three checkers that lie beside the board back on squares of their side that lack one.
local boards = require "worlds.lib.boards"
local squares = boards.checkers.squares

local lost = {} -- which men are missing: by number
for start = 1, 6 do
  lost[#lost + 1] = { count = 1, red = { 2 * start }, black = {} }
  lost[#lost + 1] = { count = 2, red = { start }, black = { 13 - start } }
  lost[#lost + 1] = { count = 3, red = { start }, black = { start + 2, 2 * start % 3 + 9 } }
end

local function is_lost(v, colour, number)
  for _, one in ipairs(lost[v.case][colour]) do
    if one == number then return true end
  end
  return false
end

return task {
  variations = each(range(1, #lost), function(case) return { count = lost[case].count, case = case } end),
  objects = function(v)
    local objects = { board = { "checkers_board", at = on_table { between(0.16, 0.21), between(-0.07, 0.07), boards.high },
      yaw = between(-math.pi, math.pi) } }
    for colour in pairs(squares) do
      for i = 1, 12 do objects[colour .. i] = { colour .. "_checker" } end
    end
    return objects
  end,
  init = function(v)
    local init = {}
    for colour, names in pairs(squares) do
      for i = 1, 12 do
        local at_home = is.inside(colour .. i, "board." .. names[i])
        init[#init + 1] = is_lost(v, colour, i) and is.on(colour .. i, "table") or at_home
      end
    end
    return init
  end,
  goal = function(v)
    local goal = {}
    for colour, names in pairs(squares) do
      for i = 1, 12 do
        local home = is.inside(colour .. i, "board." .. names[i])
        goal[#goal + 1] = is_lost(v, colour, i) and exists("?s: " .. colour .. "_square", is.inside(colour .. i, "?s")) or home
      end
    end
    return goal
  end,
  instructions = function(v)
    local n = ({ "one", "two", "three" })[v.count]
    local men = v.count == 1 and "one man that lies" or n .. " men that lie"
    return {
      "set up the game of checkers: put the " .. men .. " on the table back on the board",
      "complete the rows of the checkers board with the " .. men .. " beside it",
      n .. (v.count == 1 and " checker has" or " checkers have") .. " left the board: fill the gaps on the side of the same colour",
      "get the checkers board ready for a game",
    }
  end,
}
