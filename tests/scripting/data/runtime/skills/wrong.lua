-- Raises an error after its first call, in a helper.
local function helper(value) return value.field.missing end
return skill {
  params = { "obj: movable" },
  precondition = {},
  effect = { is.higher("obj", "obj") },
  continuous = { way = { 0, min = 0, max = 8 } },
  label = "go wrong",
  run = function(robot, p, c)
    robot:wait(0.1)
    if c.way == 1 then helper({}) end
    if c.way == 2 then while true do end end
    if c.way == 3 then robot:move_line({ 0, 0, 0 / 0 }) end
    if c.way == 6 then robot:run(act.counting { to = "bench" }) end
    if c.way == 4 then robot:move_line({ 0, 0, 0.1 }, { sped = 1 }) end
    if c.way == 7 then robot:move_to(robot:tip(), { tool = p.obj }) end
    if c.way == 8 then robot:move_line(robot:tip(), { tool = "top" }) end
    robot:move_to("cube")
  end,
}
