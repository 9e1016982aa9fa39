-- Take the plate out of the slot of one colour and lay it on the table, face up.
return task {
  variations = { colour = { "black", "red", "purple" } },
  objects = { rack = { "dish_rack" }, plate = { "plate" } },
  init = { is.on("rack", "table"), is.in_slot("plate", "rack.{colour}_slot") },
  goal = { is_not.in_slot("plate", "rack.{colour}_slot"), is.on("plate", "table") },
  also = function(w) -- it lies and does not lean
    local x, y, z = w:position("plate")
    local _, _, above = w:pose("plate"):along(0, 0, 1):position()
    return above - z > 0.99
  end,
  instructions = {
    "pull the plate out of the {colour} slot and lay it on the table",
    "the plate in the {colour} part of the dish rack is dry: lay it on the table",
    "lay the plate that stands between the {colour} posts flat on the table",
    "bring the plate from the {colour} slot of the rack to the table, face up",
  },
}
