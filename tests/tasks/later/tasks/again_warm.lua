-- The can goes into the microwave, which stands at the left side of the table and is shut again.
local yaw = -math.pi / 2 - 0.14
return task {
  variations = { where = { "left" } },
  objects = {
    microwave = { "microwave", at = on_table { between(0.06, 0.24), -(0.38 + 0.13 + 0.05) }, yaw = between(yaw - 0.2, yaw + 0.2) },
    item = { "tuna_can" },
  },
  init = { is.closed("microwave.door"), is.workable("microwave.door"), is.on("item", "table"),
    is_not.inside("item", "microwave.front") },
  goal = { is.inside("item", "microwave.shelf"), is.closed("microwave.door") },
  instructions = { "put the can into the microwave on the {where} and shut it" },
}
