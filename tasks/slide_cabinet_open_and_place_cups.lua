-- Slide one door of the cabinet open and put the cup behind it; the other door stays shut.
return task {
  variations = { side = { "left", "right" } },
  objects = {
    cabinet = { "sliding_cabinet" },
    cup = { "tumbler", colour = one_of(colours.names) },
  },
  init = { is.closed("cabinet.left_door"), is.closed("cabinet.right_door"), is.workable("cabinet.{side}_door"),
    is.on("cup", "table") },
  goal = { is.inside("cup", "cabinet.{side}_shelf"), is.open("cabinet.{side}_door"), stays("others") },
  instructions = {
    "put the cup in the {side} half of the cabinet",
    "slide the {side} door open and place the cup behind it",
    "the cup lives in the cabinet, to the {side}",
    "store the cup behind the {side} door",
  },
}
