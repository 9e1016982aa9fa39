-- Raises an error after its first call, in a helper.
local function helper(value) return value.field.missing end
return skill {
  params = { "obj: movable" },
  precondition = {},
  effect = { is.higher("obj", "obj") },
  continuous = { way = { 0, min = 0, max = 24 } },
  label = "go wrong",
  run = function(robot, p, c)
    robot:wait(0.1)
    if c.way == 1 then helper({}) end
    if c.way == 2 then while true do end end
    if c.way == 3 then robot:move_line({ 0, 0, 0 / 0 }) end
    if c.way == 6 then robot:run(act.counting { to = "bench" }) end
    if c.way == 4 then robot:move_line({ 0, 0, 0.1 }, { sped = 1 }) end
    if c.way == 21 then robot:move_to(robot:tip(), { tool = p.obj }) end
    if c.way == 22 then robot:move_line(robot:tip(), { tool = "top" }) end
    if c.way == 23 then robot:move_through({ goal = robot:tip() }, { then_follow = { { by = { 0, 0, 1 } }, { up = 1 } } }) end
    if c.way == 24 then robot:move_through({ goal = robot:tip() }, { then_part = "chest.drawer", then_follow = { { by = { 0, 0, 1 } } } }) end
    local pieces = {
      [7] = {}, [8] = { { by = { 0, 0, 1 } }, { up = 1 } }, [9] = { { by = { 0, 0, 1 } }, { by = { 0, 0 } } },
      [10] = { { arc = 1, about = "chest.drawer" } }, [11] = { { arc = 1, axis = { 0, 0, 0 }, about = { 0, 0, 0 } } },
      [12] = { { arc = 1 } }, [13] = { { speed = 1 } }, [14] = { { to = "cube" } }, [15] = { { tilt = 0 } },
      [16] = { { by = { 0, 0, 1 }, tilt = 1 } }, [17] = { { by = { 0, 0, 1 }, speed = -1 } }, [18] = { 3 },
      [19] = { { arc = 1, about = "cube" } },
    }
    if pieces[c.way] then robot:follow(pieces[c.way]) end
    if c.way == 20 then robot:move_line({ 0, 0, -0.1 }, { search = 0.01, press = 3 }) end
    robot:move_to("cube")
  end,
}
