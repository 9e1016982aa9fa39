-- One Panda arm on a pedestal behind a work table whose top is the plane z = 0.75 m; all of the top is in reach.
local function about(home, spread) return between(home - spread, home + spread) end

return world {
  robot = {
    "panda", at = { -0.30, 0, 0.75 },
    joints = { -- the arm starts near its home, elsewhere in each episode: its tip within about 20 cm
      joint1 = about(0, 0.35), joint2 = about(-math.pi / 4, 0.20), joint3 = about(0, 0.25), joint4 = about(-3 * math.pi / 4, 0.20),
      joint5 = about(0, 0.25), joint6 = about(math.pi / 2, 0.25), joint7 = about(math.pi / 4, 0.50),
    },
  },
  fixtures = {
    floor = { "floor", at = { 0.2, 0, 0 } },
    pedestal = { "pedestal", at = { -0.30, 0, 0.75 } },
    table = { "work_table", at = { 0.19, 0, 0.75 } },
  },
  cameras = { -- where RLBench has them
    left_shoulder = { at = { -0.175, 0.200, 1.980 }, look_at = { 0.22, 0.02, 0.80 }, fov = deg(40), near = 0.01, far = 3.2 },
    right_shoulder = { at = { -0.175, -0.200, 1.980 }, look_at = { 0.22, -0.02, 0.80 }, fov = deg(40), near = 0.01, far = 3.2 },
    overhead = { at = { -0.175, 0, 2.430 }, look_at = { 0.15, 0, 0.75 }, fov = deg(40), near = 0.01, far = 3.3 },
    front = { at = { 1.350, 0, 1.580 }, look_at = { 0.05, 0, 0.98 }, fov = deg(40), near = 0.01, far = 4.5 },
    wrist = { -- above the fingers, which it sees at the lower edge
      mount = "robot.hand", at = { 0.07, 0, 0 }, look_at = { 0.03, 0, 0.25 }, up = { 1, 0, 0 },
      fov = deg(60), near = 0.01, far = 3.5,
    },
  },
  sensors = {
    wrench = { "force_torque", on = "robot.hand", rate = 120 },
    joint_torque = { "joint_torque", rate = 20 },
  },
}
