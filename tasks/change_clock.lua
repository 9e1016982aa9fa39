-- Set the desk clock a quarter of an hour on: turn its minute hand to the red mark.
return task {
  objects = { clock = { "desk_clock", at = on_table { between(0.12, 0.30), between(-0.22, 0.22) }, yaw = between(-math.pi, math.pi) } },
  init = { is_not.turned("clock.minute_hand") },
  goal = { is.turned("clock.minute_hand") },
  also = function(w) return w:joint("clock.minute_hand") < deg(96) end, -- and not past the mark: at most a minute
  instructions = {
    "put the clock forward by a quarter of an hour",
    "turn the minute hand from the top to the red mark",
    "the clock is fifteen minutes slow: set it right",
    "turn the knob of the desk clock until it shows a quarter past",
  },
}
