-- Explicit steps, an ordered goal, and a test beside it.
return task {
  world = "bench",
  objects = { cube = { "cube", at = { 0, 0.1, 0.52 } }, top = { "cube", at = { 0.2, 0.1, 0.52 }, tip = { at = { 0, 0, -0.02 } } },
    chest = { "chest", at = { 0.3, -0.3, 0.5 } } },
  goal = in_order { is.holding("cube"), is.open("chest.drawer") },
  steps = {
    act.everything("cube", { height = 0.2, push = { 3, 2, 1 }, grasp = { 0, 0, 0.1, 0, 0, 0, 1 }, controller = "joint_position" }),
    act.counting { to = "bench", controller = "cartesian_impedance" },
  },
  also = function(w) return w:has_trait("cube", "graspable") and w:attribute("cube", "colour") == "green" end,
  instructions = { "do it" },
}
