-- Pull one drawer of the chest out; the other two stay shut.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { level = { "bottom", "middle", "top" } },
  objects = { chest = { "chest", place = places.round_the_table(0.12, deg(22), 0.75, 0, 0.26) } },
  init = function(v)
    return { is.closed("chest.bottom_drawer"), is.closed("chest.middle_drawer"), is.closed("chest.top_drawer"),
      is.workable("chest." .. v.level .. "_drawer") }
  end,
  goal = function(v)
    local goal = { is.open("chest." .. v.level .. "_drawer"), is.hand_empty() }
    for _, level in ipairs { "bottom", "middle", "top" } do
      if level ~= v.level then goal[#goal + 1] = is.closed("chest." .. level .. "_drawer") end
    end
    return goal
  end,
  instructions = {
    "pull out the {level} drawer of the chest",
    "the {level} drawer is wanted: open it by its handle",
    "open the {level} drawer and leave the others shut",
    "let the {level} drawer of the chest stand open",
  },
}
