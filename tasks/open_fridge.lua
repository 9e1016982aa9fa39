-- Open the door of the fridge; the freezer above it stays shut.
return task {
  objects = { fridge = { "fridge" } },
  init = { is.closed("fridge.door"), is.closed("fridge.freezer_door"), is.workable("fridge.door") },
  goal = { is.open("fridge.door"), stays("others") },
  instructions = {
    "open the fridge",
    "pull the door of the fridge open by its handle",
    "something must go into the fridge: open it",
    "let the large lower door of the fridge stand wide open",
  },
}
