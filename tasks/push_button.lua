-- Press the button, whose cap has one of eighteen colours.
return task {
  variations = {
    colour = { "maroon", "green", "blue", "navy", "yellow", "cyan", "magenta", "silver", "grey", "orange", "olive", "purple",
      "teal", "azure", "violet", "rose", "black", "white" },
  },
  objects = {
    button = { "push_button", colour = "{colour}", at = on_table { between(0.06, 0.36), between(-0.32, 0.32) },
      yaw = between(-math.pi, math.pi) },
  },
  init = { is_not.pressed("button.cap") },
  goal = is.pressed("button.cap"),
  instructions = {
    "push the {colour} button",
    "press down the {colour} button on the table",
    "push the {colour} cap down with a fingertip",
    "find the {colour} button and press it",
  },
}
