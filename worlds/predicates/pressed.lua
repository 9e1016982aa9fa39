-- The button has been pressed to its contact point in this episode.
return predicate {
  params = { "button: pressable" },
  label = "the {button} has been pressed",
  momentary = true,
  remember = true,
  margin_unit = "m",
  holds = function(w, button)
    local beyond = w:joint(button) - w:number(button, "on_at")
    return beyond >= 0, beyond
  end,
}
