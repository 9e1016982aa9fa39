-- Put the solid that is named through its hole into the shape sorter; the other four stay on the table.
local words = { cube = "cube", cylinder = "cylinder", prism = "triangular prism", star = "star", moon = "moon" }

return task {
  variations = { form = { "cube", "cylinder", "prism", "star", "moon" } },
  objects = {
    sorter = { "shape_sorter" }, cube = { "sorter_cube" }, cylinder = { "sorter_cylinder" }, prism = { "sorter_prism" },
    star = { "sorter_star" }, moon = { "sorter_moon" },
  },
  init = { is.on("sorter", "table"), is.on("cube", "table"), is.on("cylinder", "table"), is.on("prism", "table"),
    is.on("star", "table"), is.on("moon", "table"), is_not.crowds("sorter", "{form}") },
  goal = { is.in_slot("{form}", "sorter.{form}_hole"), stays("others") },
  instructions = function(v)
    local what = words[v.form]
    return { "put the " .. what .. " into the shape sorter", "post the " .. what .. " through the hole that fits it",
      "find the " .. what .. " and its hole in the sorting box", "the " .. what .. " belongs in the box: sort it" }
  end,
}
