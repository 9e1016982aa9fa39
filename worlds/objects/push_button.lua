-- A push button that springs back: 5 mm of travel, 4 N.
return object {
  type = "fixture", traits = {}, colour = "red",
  shapes = { box { 0.07, 0.07, 0.02, at = { 0, 0, 0.01 }, colour = { 0.2, 0.2, 0.22 } } },
  parts = {
    cap = {
      type = "button", traits = { "pressable" },
      slider = { axis = { 0, 0, -1 }, at = { 0, 0, 0.02 }, range = { 0, 0.005 }, spring = 4, damping = 1, friction = 0.2 },
      shapes = { cylinder { 0.02, 0.016, at = { 0, 0, 0.008 } } },
      mass = 0.04, numbers = { on_at = 0.0035 },
    },
  },
}
