-- Open the dishwasher, pull its rack out and lay the plate that stands in it on the table.
return task {
  objects = { dishwasher = { "dishwasher" }, plate = { "plate" } },
  init = { is.closed("dishwasher.door"), is.closed("dishwasher.rack"),
    is.workable("dishwasher.door"), is.workable_behind("dishwasher.rack", "dishwasher.door"), is.in_slot("plate", "dishwasher.rack.slot") },
  goal = { is.on("plate", "table") },
  instructions = {
    "empty the dishwasher",
    "take the plate out of the dishwasher and lay it on the table",
    "the plate in the dishwasher is clean: put it on the table",
    "open the dishwasher, pull the rack out and get the plate",
  },
}
