-- What a language server underlines: each line marked so.
return task {
  objects = { tin = { "tin", mass = "heavy" } }, -- wrong
  init = {
    is.onn("tin", "table"), -- wrong
    is_not.holdin("tin"), -- wrong
    is.on("tin"), -- wrong
  },
  gaol = { is.on("tin", "table") }, -- wrong
  goal = is.lifted("tin"),
  horizon = "long", -- wrong
  steps = { act.pik("tin") }, -- wrong
  instruction = { "lift the tin" }, -- wrong
  instructions = { "lift the tin" },
}
