-- A fat bean that lies on its side; a hand takes it from above, across.
local function turned(yaw) return { at = { 0, 0, 0.003 }, rpy = { math.pi, 0, yaw }, width = 0.030, approach = 0.08, force = 10 } end

return object {
  type = "food", traits = { "movable", "graspable" }, mass = 0.03, rolling = 0.0003, colour = { 0.55, 0.18, 0.12 },
  shape = capsule { 0.015, 0.014, rpy = { 0, math.pi / 2, 0 } },
  grasps = { turned(0), turned(math.pi) },
}
