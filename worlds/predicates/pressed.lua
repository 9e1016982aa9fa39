-- The button has been pressed to its contact point in this episode.
return predicate {
  params = { "button: pressable" },
  label = "the {button} has been pressed",
  momentary = true,
  remember = true,
  holds = function(w, button) return w:joint(button) >= w:number(button, "on_at") end,
}
