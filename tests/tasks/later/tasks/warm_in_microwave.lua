-- Something goes into the microwave, which is shut and is shut again.
return task {
  variations = { thing = { "tuna_can", "money", "steak" } },
  objects = function(v)
    return {
      microwave = { "microwave", at = on_table { between(0.57, 0.60), between(-0.22, 0.22) }, yaw = between(deg(-11), deg(11)) },
      item = { v.thing },
    }
  end,
  init = { is.closed("microwave.door"), is.workable("microwave.door"), is.on("item", "table"),
    is_not.inside("item", "microwave.front") },
  goal = { is.inside("item", "microwave.shelf"), is.closed("microwave.door") },
  instructions = { "put the {thing} into the microwave and shut it" },
}
