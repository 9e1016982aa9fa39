-- Swing the flap of the oven down.
return task {
  objects = { oven = { "oven" } },
  init = { is.closed("oven.door"), is.workable("oven.door") },
  goal = { is.open("oven.door") },
  instructions = {
    "open the oven",
    "swing the flap of the oven down",
    "let the oven air: open its door",
    "pull the door of the oven down until it lies level",
  },
}
