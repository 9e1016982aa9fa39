-- Shut the drawer that stands open.
local places = require "worlds.lib.places"

return task {
  world = "tabletop",
  variations = { level = { "bottom", "middle", "top" } },
  objects = function(v)
    return {
      chest = { "chest", place = places.round_the_table { gap = 0.12, turn = deg(22), wide = 0.26 },
        joints = { [v.level .. "_drawer"] = between(0.08, 0.14) } },
    }
  end,
  init = function(v) return { is_not.closed("chest." .. v.level .. "_drawer"), is.workable("chest." .. v.level .. "_drawer") } end,
  goal = function(v) return { is.closed("chest." .. v.level .. "_drawer") } end,
  instructions = {
    "push the {level} drawer back into the chest",
    "the {level} drawer stands open: push it home",
    "close the {level} drawer of the chest until no gap is left",
    "make sure that the {level} drawer ends up closed",
  },
}
