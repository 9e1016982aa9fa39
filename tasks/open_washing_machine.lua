-- Open the round door of the washing machine.
return task {
  objects = { machine = { "washing_machine" } },
  init = { is.closed("machine.door"), is.workable("machine.door") },
  goal = { is.open("machine.door") },
  instructions = {
    "open the washing machine",
    "pull the round door of the washing machine open",
    "the laundry is done: open the machine",
    "swing the door of the washing machine aside by its handle",
  },
}
