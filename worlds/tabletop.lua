-- One Panda arm on a pedestal behind a work table whose top is the plane z = 0.75 m; all of the top is in reach.
return world {
  robot = { "panda", at = { -0.30, 0, 0.75 } },
  fixtures = {
    floor = { "floor", at = { 0.2, 0, 0 } },
    pedestal = { "pedestal", at = { -0.30, 0, 0.75 } },
    table = { "work_table", at = { 0.19, 0, 0.75 } },
  },
  cameras = {
    front = { at = { 1.35, 0, 1.58 }, look_at = "table", fov = deg(40), size = { 128, 128 }, near = 0.01, far = 4.5 },
    overhead = { at = { 0.10, 0, 2.0 }, look_at = "table", fov = deg(40), size = { 128, 128 }, near = 0.01, far = 4.5 },
  },
}
