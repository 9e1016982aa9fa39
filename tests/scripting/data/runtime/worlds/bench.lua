-- A small arm on a bench whose top is the plane z = 0.5 m.
return world {
  robot = { "mini", at = { -0.4, 0, 0.5 } },
  fixtures = { bench = { "bench", at = { 0, 0, 0.5 } } },
  cameras = {
    above = { at = { 0, 0, 2 }, look_at = "bench", fov = deg(60), size = { 64, 48 }, near = 0.1, far = 3 },
    wrist = { mount = "robot.hand", at = { 0.05, 0, 0.02 } },
  },
  regions = { corner = { at = { 0.2, 0.2, 0.6 }, size = { 0.2, 0.2, 0.2 } } },
}
