-- Pull one drawer of the chest out; the other two stay shut.
return task {
  variations = { level = { "bottom", "middle", "top" } },
  objects = { chest = { "chest" } },
  init = { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
    is.workable("chest.{level}_drawer") },
  goal = { is.open("chest.{level}_drawer"), stays("others") },
  instructions = {
    "pull out the {level} drawer of the chest",
    "the {level} drawer is wanted: open it by its handle",
    "open the {level} drawer and leave the others shut",
    "let the {level} drawer of the chest stand open",
  },
}
