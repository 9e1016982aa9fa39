-- Franka Emika Panda, seven joints and a two-finger hand.
return robot {
  urdf = "panda.urdf",
  arm = { "joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7" },
  fingers = { "left_finger", "right_finger" },
  pads = { "left_finger", "right_finger" },
  tip = { link = "hand", at = { 0, 0, 0.1034 } },
  home = { 0, -math.pi / 4, 0, -3 * math.pi / 4, 0, math.pi / 2, math.pi / 4 },
  limits = { -- beside those of the URDF
    acceleration = { 15, 7.5, 10, 12.5, 15, 20, 20 }, -- rad/s^2
    jerk = { 7500, 3750, 5000, 6250, 7500, 10000, 10000 }, -- rad/s^3
  },
  opening = 0.08,
  grip_force = 20,
  finger_speed = 0.1,
  pad_friction = 1.0,
}
