-- Put the one to three chess pieces that stand in the middle of the board back on their squares.
local boards, chess = require "worlds.lib.boards", require "worlds.lib.chess"
local men = chess.men

-- Who stands where instead, for each of six cases of 1, 2 and 3 pieces.
local function astray(v)
  local places = {}
  for k = 1, v.count do
    local file = ((v.case * 3 + k * 5) % 8 + 1) --[[@as integer]]
    places[men[(v.case * 11 + v.count * 7 + k * 13) % #men + 1].name] = string.sub("abcdefgh", file, file) .. 3 + (v.case + k) % 4
  end
  return places
end

return task {
  variations = { count = { 1, 2, 3 }, case = range(1, 6) },
  objects = function()
    local objects = { board = { "chess_board", at = on_table { between(0.16, 0.21), between(-0.07, 0.07), boards.high },
      yaw = between(-math.pi, math.pi) } }
    for _, man in ipairs(men) do objects[man.name] = { "chess_" .. man.kind, colour = man.colour } end
    return objects
  end,
  init = function(v)
    local init, places = {}, astray(v)
    for _, man in ipairs(men) do init[#init + 1] = is.inside(man.name, "board." .. (places[man.name] or man.square)) end
    return init
  end,
  goal = function()
    local goal = {}
    for _, man in ipairs(men) do goal[#goal + 1] = is.inside(man.name, "board." .. man.square) end
    return goal
  end,
  instructions = function(v)
    local n = ({ "one", "two", "three" })[v.count]
    return {
      "set up the chess board: " .. n .. (v.count == 1 and " piece is" or " pieces are") .. " not where a game begins",
      "put the " .. (v.count == 1 and "chess piece" or n .. " chess pieces") .. " in the middle of the board back home",
      "prepare a game of chess: " .. n .. " of the pieces must go back to " .. (v.count == 1 and "its square" or "their squares"),
      "complete the two rows of each side of the chess board",
    }
  end,
}
