-- Open the door of the microwave.
return task {
  objects = { microwave = { "microwave" } },
  init = { is.closed("microwave.door"), is.workable("microwave.door") },
  goal = { is.open("microwave.door") },
  instructions = {
    "open the microwave",
    "pull the door of the microwave open by its handle",
    "something must go into the microwave: open it",
    "let the microwave stand wide open",
  },
}
