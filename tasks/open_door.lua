-- Turn the lever of the door and pull the door open.
return task {
  objects = { doorway = { "doorway" } },
  init = { is.closed("doorway.door"), is.workable("doorway.door") },
  goal = { is.open("doorway.door") },
  instructions = {
    "open the door",
    "press the handle down and pull the door open",
    "turn the lever, then swing the door towards you",
    "let somebody in: open the door by its handle",
  },
}
