-- Put the one grocery that is named into the cupboard beside the table.
local groceries = { "chocolate_jelly", "coffee", "crackers_box", "mustard", "soup_can", "spam_can", "strawberry_jelly",
  "sugar_box", "tuna_can" }
local words = { chocolate_jelly = "chocolate jelly", coffee = "coffee", crackers_box = "crackers", mustard = "mustard",
  soup_can = "soup", spam_can = "tin of meat", strawberry_jelly = "strawberry jelly", sugar_box = "sugar", tuna_can = "tuna" }

return task {
  variations = { item = groceries },
  objects = function()
    local things = { cupboard = { "cupboard" } }
    for _, name in ipairs(groceries) do things[name] = { name } end
    return things
  end,
  init = function(v)
    local parts = { is.on(v.item, "table"), is.reachable(v.item) }
    for _, name in ipairs(groceries) do
      if name ~= v.item then
        parts[#parts + 1] = is.apart(name, v.item)
        parts[#parts + 1] = is.on(name, "table")
      end
    end
    return parts
  end,
  goal = is.inside("{item}", "cupboard.shelf"),
  instructions = function(v)
    local what = words[v.item]
    return { "stow the " .. what .. " on the shelf of the cupboard", "the cupboard is where the " .. what .. " should go",
      "tidy the " .. what .. " away into the cupboard beside the table", "of all the groceries shelve just the " .. what }
  end,
}
