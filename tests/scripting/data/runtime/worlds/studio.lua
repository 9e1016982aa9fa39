-- The bench, with everything that can be said about being seen.
return world {
  robot = { "mini", at = { -0.4, 0, 0.5 } },
  fixtures = { bench = { "bench", at = { 0, 0, 0.5 } } },
  cameras = {
    above = { at = { 0, 0, 2 }, look_at = "bench", fov = deg(60), size = { 64, 48 }, near = 0.1, far = 3 },
    wrist = { mount = "robot.hand", at = { 0.05, 0, 0.02 } },
  },
  calibration = "studio_cameras.json",
  sensors = {
    wrench = { "force_torque", on = "robot.fore", rate = 60 },
    torque = { "joint_torque", rate = 20 },
  },
  light = { direction = { 0, 0, -1 }, colour = "white", ambient = 0.3, diffuse = 0.7, specular = 0 },
  randomise = {
    looks = { "bench", "wedge", "chest" }, colours = colours.names, textures = { "plain", checker { "red", "blue" } },
    ambient = { 0.2, 0.6 }, light_direction = deg(20), camera_position = 0.01, dynamics = { "*" }, mass = { 0.5, 2 },
  },
  observe = {
    images = "keyframes", cameras = { "above" }, size = { 32, 24 }, kinds = { "rgb", "depth" },
    noise = { rgb = 0.02 }, channels = { "wrench" },
  },
}
