-- A shallow tray of painted wood with a low rim; its frame is on the floor inside, 5 mm above what it stands on.
return object {
  type = "tray", traits = { "surface", "support" }, fixed = true, friction = 0.6,
  shapes = {
    box { 0.16, 0.235, 0.005, at = { 0, 0, -0.0025 } },
    box { 0.004, 0.235, 0.013, at = { 0.082, 0, 0.0015 } },
    box { 0.004, 0.235, 0.013, at = { -0.082, 0, 0.0015 } },
    box { 0.168, 0.004, 0.013, at = { 0, 0.1195, 0.0015 } },
    box { 0.168, 0.004, 0.013, at = { 0, -0.1195, 0.0015 } },
  },
}
