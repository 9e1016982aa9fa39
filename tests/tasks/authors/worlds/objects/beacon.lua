-- A beacon that lights while its cap has been pressed.
return object {
  type = "fixture", traits = {}, fixed = true, colour = { 0.25, 0.25, 0.28 },
  shapes = {
    box { 0.08, 0.16, 0.02, at = { 0, 0, 0.01 } },
    sphere { 0.02, at = { 0, 0.05, 0.04 }, colour = { 0.30, 0.30, 0.30 }, shows = is_not.pressed("cap") },
    sphere { 0.02, at = { 0, 0.05, 0.04 }, colour = { 1.00, 0.85, 0.20 }, shows = is.pressed("cap") },
  },
  parts = {
    cap = {
      type = "button", traits = { "pressable" }, mass = 0.04, numbers = { on_at = 0.0035 }, colour = "red",
      slider = { axis = { 0, 0, -1 }, at = { 0, -0.04, 0.02 }, range = { 0, 0.005 }, spring = 4, damping = 1, friction = 0.2 },
      shapes = { cylinder { 0.02, 0.016, at = { 0, 0, 0.008 } } },
    },
  },
}
