-- The pieces of a game of chess and their board.
local boards = require "worlds.lib.boards"
local chess = {}

-- Heights in m; head: radius and height of what the fingers take, the top but for an ornament.
local kinds = {
  pawn = { high = 0.040, head = 0.0080 }, rook = { high = 0.044, head = 0.0100 }, knight = { high = 0.048, head = 0.0085 },
  bishop = { high = 0.052, head = 0.0085 }, queen = { high = 0.058, head = 0.0095 }, king = { high = 0.060, head = 0.0095 },
}
local order = { "rook", "knight", "bishop", "queen", "king", "bishop", "knight", "rook" }
local middle = 0.020 -- m: of a piece's frame above its foot

-- Fields of an object: a piece of turned wood, 2.6 cm across at its foot.
function chess.piece(name)
  local kind = kinds[name]
  local top, head = kind.high - middle, kind.head
  local shapes = {
    cylinder { 0.013, 0.008, at = { 0, 0, 0.004 - middle } },
    cylinder { 0.0065, kind.high - 0.024, at = { 0, 0, (kind.high - 0.008) / 2 - middle } },
    cylinder { head, 0.016, at = { 0, 0, top - 0.008 } },
  }
  ---@type stampede.shape[]
  local visual = { lathe { { 0.013, -middle }, { 0.013, 0.005 - middle }, { 0.009, 0.010 - middle }, { 0.0055, top - 0.020 },
    { head, top - 0.016 }, { head, top - (name == "pawn" and 0.006 or 0.002) }, { 0.003, top }, segments = 20 } }
  if name == "king" then
    visual[2] = box { 0.003, 0.003, 0.010, at = { 0, 0, top + 0.004 } }
    visual[3] = box { 0.003, 0.009, 0.003, at = { 0, 0, top + 0.005 } }
  elseif name == "queen" then
    visual[2] = sphere { 0.0035, at = { 0, 0, top + 0.002 } }
  elseif name == "knight" then
    visual[2] = box { 0.017, 0.009, 0.010, at = { 0.002, 0, top - 0.009 }, rpy = { 0, 0.5, 0 } }
  elseif name == "rook" then
    for k = 0, 3 do
      local angle = k * math.pi / 2
      visual[#visual + 1] = box { 0.004, 0.005, 0.005, at = { 0.0075 * math.cos(angle), 0.0075 * math.sin(angle), top }, rpy = { 0, 0, angle } }
    end
  end
  local grasps = {}
  for k = 0, 7 do
    grasps[#grasps + 1] = { at = { 0, 0, top - 0.007 }, rpy = { math.pi, 0, k * math.pi / 4 }, width = 2 * head, approach = 0.06, force = 15 }
  end
  return { type = "chess_piece", traits = { "movable", "graspable" }, mass = 0.03, friction = 0.6, colour = "white", shapes = shapes,
    visual = visual, grasps = grasps }
end

-- All 32 men: { name, kind, colour, square }.
chess.men = {}
for file = 1, 8 do
  for _, side in ipairs { { "white", 1, 2 }, { "black", 8, 7 } } do
    local letter = string.sub("abcdefgh", file, file)
    chess.men[#chess.men + 1] = { name = side[1] .. "_" .. order[file] .. "_" .. letter, kind = order[file], colour = side[1], square = letter .. side[2] }
    chess.men[#chess.men + 1] = { name = side[1] .. "_pawn_" .. letter, kind = "pawn", colour = side[1], square = letter .. side[3] }
  end
end

-- A region for each square, by its name in the game: "a1" … "h8".
chess.regions = {}
for file = 1, 8 do
  for rank = 1, 8 do chess.regions[string.sub("abcdefgh", file, file) .. rank] = boards.spot(file, rank, 0.044) end
end

return chess
