-- Flip the rocker switch to its other side.
return task {
  objects = { switch = { "rocker_switch", at = on_table { between(0.06, 0.36), between(-0.30, 0.30) }, yaw = between(-math.pi, math.pi) } },
  init = { is_not.pressed("switch.rocker") },
  goal = { is.pressed("switch.rocker") },
  also = function(w) return w:joint("switch.rocker") > w:number("switch.rocker", "on_at") end, -- and it stays there
  instructions = {
    "flip the switch",
    "press down the raised end of the rocker switch",
    "flip the rocker over with a fingertip",
    "push the end of the switch that bears a red mark down until it stays",
  },
}
