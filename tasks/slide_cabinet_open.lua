-- Slide one of the two doors of the cabinet open; the other one stays shut.
return task {
  variations = { side = { "left", "right" } },
  objects = { cabinet = { "sliding_cabinet" } },
  init = { is.closed("cabinet.left_door"), is.closed("cabinet.right_door"), is.workable("cabinet.{side}_door") },
  goal = { is.open("cabinet.{side}_door"), stays("others") },
  instructions = {
    "slide the {side} door of the cabinet open",
    "push the {side} door aside by its handle",
    "open the {side} half of the cabinet",
    "the {side} door has to go: slide it to the side and leave the other one shut",
  },
}
