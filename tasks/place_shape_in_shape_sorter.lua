-- Put the solid that is named through its hole into the shape sorter; the other four stay on the table.
local forms = { "cube", "cylinder", "prism", "star", "moon" }
local words = { cube = "cube", cylinder = "cylinder", prism = "triangular prism", star = "star", moon = "moon" }

return task {
  world = "tabletop",
  variations = { form = forms },
  objects = {
    sorter = { "shape_sorter" }, cube = { "sorter_cube" }, cylinder = { "sorter_cylinder" }, prism = { "sorter_prism" },
    star = { "sorter_star" }, moon = { "sorter_moon" },
  },
  init = function(v)
    local parts = { is.on("sorter", "table") }
    for _, form in ipairs(forms) do parts[#parts + 1] = is.on(form, "table") end
    parts[#parts + 1] = is_not.crowds("sorter", v.form)
    return parts
  end,
  goal = function(v) return { is.in_slot(v.form, "sorter." .. v.form .. "_hole"), stays("others") } end,
  instructions = function(v)
    local what = words[v.form]
    return { "put the " .. what .. " into the shape sorter", "post the " .. what .. " through the hole that fits it",
      "find the " .. what .. " and its hole in the sorting box", "the " .. what .. " belongs in the box: sort it" }
  end,
}
