-- Boards of eight by eight squares for games; their pieces stand on the squares' middles.
local boards = {}
boards.pitch, boards.high = 0.042, 0.014 -- m: of a square; of the board

-- From the middle of the board to that of a square; file and rank 1 … 8.
function boards.square(file, rank) return (rank - 4.5) * boards.pitch, (file - 4.5) * boards.pitch end

-- The shapes of a board: a frame and its dark squares.
function boards.shapes(light, dark)
  local whole = 8 * boards.pitch
  local shapes = {
    box { whole + 0.03, whole + 0.03, boards.high, at = { 0, 0, -boards.high / 2 }, colour = dark },
    box { whole, whole, 0.0004, colour = light, collides = false },
  }
  for file = 1, 8 do
    for rank = 1, 8 do
      local x, y = boards.square(file, rank)
      if (file + rank) % 2 == 0 then
        shapes[#shapes + 1] = box { boards.pitch, boards.pitch, 0.0004, at = { x, y, 0.0003 }, colour = dark, collides = false }
      end
    end
  end
  return shapes
end

-- A region on a square for one piece: its middle must be within 11 mm of the square's.
function boards.spot(file, rank, high)
  local x, y = boards.square(file, rank)
  return { at = { x, y, high / 2 }, size = { 0.022, 0.022, high + 0.004 }, traits = { "container", "spot" } }
end

---@type { regions: table<string, table>, squares: table<string, string[]> }
boards.checkers = { regions = {}, squares = { red = {}, black = {} } } -- the squares of each side's men, by name
for _, rank in ipairs { 1, 2, 3, 6, 7, 8 } do
  for file = 1, 8 do
    if (file + rank) % 2 == 0 then
      local colour = rank < 4 and "red" or "black"
      local of_colour = boards.checkers.squares[colour]
      local name, spot = colour .. "_square" .. #of_colour + 1, boards.spot(file, rank, 0.016)
      table.insert(of_colour, name)
      spot.type = colour .. "_square"
      boards.checkers.regions[name] = spot
    end
  end
end

return boards
