-- Put the held object down on its marked spot of a surface: a square of a board, a place at a table.
return skill {
  params = { "obj: movable", "spot: spot" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not(exists("?y: movable", is.inside("?y", "spot"))),
    forall("?z: spot", any_of { is_not.rests_on("spot", "?z"), exists("?y: movable", is.inside("?y", "?z")) }) },
  effect = { is.inside("obj", "spot"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  forgets = { "on" },                                                   -- what the spot is of, or what lies below it
  continuous = { at = stream(is.inside("obj", "spot")) },               -- pose of the object
  label = "put the {obj} on the {spot}",
  verbs = { "put", "lower", "sort", "weigh", "stand" },
  run = function(robot, p, c)
    local down = robot:tip_for(p.obj, c.at:offset(0, 0, 0.001))
    robot:move_through { approach = down:offset(0, 0, 0.08), place = down }
    robot:wait(0.1)
    robot:open_hand(robot:view():opening() + 0.02)                      -- no wider: there may be neighbours
    robot:lift(0.08)
  end,
}
