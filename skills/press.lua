-- Press a button down to its contact point with the closed fingers and let it come back; a switch stays. Where it is
-- pressed says its region `spot`, else its middle; how far its number `travel`, else `depth`.
return skill {
  params = { "button: pressable" },
  precondition = { is.hand_empty() },
  effect = { is.pressed("button") },
  continuous = { depth = { 0.010, min = 0.006, max = 0.015, unit = "m" } }, -- below the top of the button at rest
  label = "press the {button}",
  verbs = { "press", "push" },
  run = function(robot, p, c)
    local w = robot:view()
    robot:close_hand()
    local spot, depth = p.button, w:number(p.button, "travel") or c.depth
    if w:exists(p.button .. ".spot") then spot = p.button .. ".spot" end
    local x, y, z = w:position(spot)
    if spot == p.button then z = w:top(p.button) end
    local _, _, turn = robot:tip():rpy()
    local fingers = 0.009 -- m that they end beyond the tip
    local above = pose(x, y, z + fingers + 0.003, math.pi, 0, turn) -- straight down, turned as it is
    robot:move_through { approach = above:offset(0, 0, 0.05), goal = above }
    robot:move_line({ 0, 0, -0.003 - depth }, { speed = 0.05, most_force = 15 }) -- a little beyond the stop: it gives way
    robot:wait(0.1)
    robot:lift(0.08)
    robot:open_hand()
  end,
}
