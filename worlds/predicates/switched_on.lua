-- A remote control that points at it has had its power button pressed.
return predicate {
  params = { "set: aim" },
  label = "the {set} is switched on",
  derived = exists("?r: pointable", { is.pointing_at("?r", "set"), is.pressed("?r.power_button") }),
}
