-- Counts its runs in an upvalue and waits that long: each run must find 1.
local runs = 0
return skill {
  params = { "obj: movable", "to: surface" },
  precondition = {},
  effect = { is.on("obj", "to") },
  label = "count",
  run = function(robot)
    runs = runs + 1
    robot:wait(runs)
    runs = runs + 1
    robot:wait(runs)
  end,
}
