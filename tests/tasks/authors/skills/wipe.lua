-- Wipe a stain with the tip of what is held: over its middle, from one side to the other and back.
return skill {
  params = { "tool: movable & tool", "stain: stain" },
  precondition = { is.holding("tool") },
  effect = { is.wiped("stain") },
  continuous = { height = { 0.002, min = 0, max = 0.01, unit = "m" } }, -- of the tip above the table
  label = "wipe the {stain} with the {tool}",
  run = function(robot, p, c)
    local w = robot:view()
    local x, y, z = w:position(p.stain)
    local _, _, yaw = w:pose(p.tool .. ".tip"):rpy()
    local middle = pose(x, y, z + c.height, math.pi, 0, yaw)
    local tool = { tool = p.tool, speed = 0.1 }
    robot:move_through({ approach = middle:offset(0, -0.03, 0.06), goal = middle:offset(0, -0.03, 0) }, { tool = p.tool })
    robot:move_line(middle:offset(0, 0.03, 0), tool)
    robot:move_line(middle:offset(0, -0.03, 0), tool)
    robot:lift(0.06)
  end,
}
