-- Shut the drawer that stands open.
return task {
  variations = { level = { "bottom", "middle", "top" } },
  objects = function(v) return { chest = { "chest", joints = { [v.level .. "_drawer"] = between(0.08, 0.14) } } } end,
  init = { is_not.closed("chest.{level}_drawer"), is.workable("chest.{level}_drawer") },
  goal = is.closed("chest.{level}_drawer"),
  instructions = {
    "push the {level} drawer back into the chest",
    "the {level} drawer stands open: push it home",
    "close the {level} drawer of the chest until no gap is left",
    "make sure that the {level} drawer ends up closed",
  },
}
