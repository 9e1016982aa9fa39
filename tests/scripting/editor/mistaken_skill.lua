-- What a language server underlines: each line marked so.
return skill {
  params = { "obj: movable" },
  precondition = { is.holding("obj"), is.moveable("obj") }, -- wrong
  effect = { is.lifted() }, -- wrong
  label = 3, -- wrong
  run = function(robot, p)
    local w = robot:view()
    robot:mov_to(w:tip()) -- wrong
    robot:wait("long") -- wrong
    robot:lift(w:posiiton(p.obj)) -- wrong
    robot:lift(w:number(p.obj, "graps")) -- wrong
    robot:move_to(robot:tip():alnog(0, 0, 0.1)) -- wrong
  end,
}
