-- Bring the tip of the hand into the target.
return skill {
  params = { "place: target" },
  precondition = { is_not.at("place") },
  effect = { is.at("place"), forall("?other: target", when(is_not(equal("?other", "place")), is_not.at("?other"))) },
  label = "reach the {place}",
  verbs = { "reach", "find" },
  run = function(robot, p)
    local place = robot:view():pose(p.place)
    robot:move_to(robot:tip():with_position(place:position()))
  end,
}
