-- Pick up the small solid of one form and hold it in the zone in the air; the other four stay where they are.
local words = { cube = "cube", cylinder = "cylinder", prism = "triangular prism", star = "star", moon = "moon" }

return task {
  variations = { form = { "cube", "cylinder", "prism", "star", "moon" } },
  objects = {
    small_cube = { "small_cube" },
    small_cylinder = { "small_cylinder" },
    small_prism = { "small_prism" },
    small_star = { "small_star" },
    small_moon = { "small_moon" },
    zone = { "air_zone", at = { between(0.10, 0.28), between(-0.22, 0.22), between(0.95, 1.10) } },
  },
  init = { is.on("small_cube", "table"), is.on("small_cylinder", "table"), is.on("small_prism", "table"),
    is.on("small_star", "table"), is.on("small_moon", "table") },
  goal = { is.holding("small_{form}"), is.inside("small_{form}", "zone") },
  instructions = function(v)
    local what = words[v.form]
    return {
      "find the " .. what .. " among the small shapes and raise it into the marked space",
      "grasp the small " .. what .. " and hold it in the green box in the air",
      "carry the " .. what .. " up into the green zone and keep it there",
      "of the five small solids take the " .. what .. " to the floating zone",
    }
  end,
}
