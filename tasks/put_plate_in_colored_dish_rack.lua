-- Put the plate into the slot of one colour of the dish rack; it stands on a stand of its own.
local racks = require "worlds.lib.dish_racks"

return task {
  variations = { colour = colours.names },
  objects = function(v)
    local others = colours.except(v.colour)
    local row = { others[1 + #v.colour % 4], others[6 + #v.colour % 3] }
    table.insert(row, 1 + #v.colour % 3, v.colour) -- not always in the middle
    local rack = racks(each(row, function(colour) return { colour .. "_slot", colour } end))
    return { rack = { "dish_rack", shapes = rack.shapes, regions = rack.regions }, stand = { "plate_stand" }, plate = { "plate" } }
  end,
  init = { is.on("rack", "table"), is.on("stand", "table"), is.apart("stand", "rack"), is.in_slot("plate", "stand.slot") },
  goal = is.in_slot("plate", "rack.{colour}_slot"),
  instructions = {
    "put the plate between the {colour} posts of the dish rack",
    "the plate belongs in the {colour} slot of the rack",
    "move the plate from its stand to the {colour} part of the dish rack",
    "stand the plate in the {colour} slot",
  },
}
