-- Three joints and a hand of two fingers.
return robot {
  urdf = "mini.urdf",
  arm = { "joint1", "joint2", "joint3" },
  fingers = { "left", "right" },
  pads = { "left", "right" },
  tip = { link = "hand", at = { 0, 0, 0.1 } },
  home = { 0, 0.5, 1.0 },
  limits = { acceleration = 5, jerk = { 100, 200, 300 } },
  opening = 0.06,
  grip_force = 15,
}
