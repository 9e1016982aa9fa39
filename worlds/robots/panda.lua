-- Franka Emika Panda, seven joints and a two-finger hand.
return robot {
  urdf = "panda.urdf",
  arm = { "panda_joint1", "panda_joint2", "panda_joint3", "panda_joint4", "panda_joint5", "panda_joint6", "panda_joint7" },
  fingers = { "panda_finger_joint1", "panda_finger_joint2" },
  pads = { "panda_leftfinger", "panda_rightfinger" },
  tip = { part = "panda_hand", at = { 0, 0, 0.1034 } },
  home = { 0, -math.pi / 4, 0, -3 * math.pi / 4, 0, math.pi / 2, math.pi / 4 },
  acceleration = { 15, 7.5, 10, 12.5, 15, 20, 20 }, -- rad/s^2
  jerk = { 7500, 3750, 5000, 6250, 7500, 10000, 10000 }, -- rad/s^3
  opening = 0.08,
  grip_force = 20,
  finger_speed = 0.1,
  pad = { friction = 1.0, rolling = 0.01, spinning = 0.01, anchor = true },
}
