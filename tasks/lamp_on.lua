-- Switch the table lamp on by the button on its foot.
return task {
  objects = {
    lamp = { "table_lamp", at = on_table { between(0.10, 0.30), between(-0.22, 0.22) },
      yaw = between(-math.pi, math.pi) },
  },
  init = { is_not.pressed("lamp.button") },
  goal = is.pressed("lamp.button"),
  instructions = {
    "switch the lamp on",
    "press the button on the foot of the lamp to light it",
    "the lamp is dark: make it shine",
    "let there be light: push the lamp's button",
  },
}
