-- Put the held object straight into a slot, cradle, socket or rack and let go. A slot with the number `search` [m] lets
-- the hand look for its mouth so far around, where the object meets its edge; `pitch`: from turn to turn.
return skill {
  params = { "obj: movable", "slot: slot" },
  moves = { "obj" },
  precondition = { is.holding("obj"), is_not.in_slot("obj", "slot"), is_not.blocked("slot") },
  effect = { is.in_slot("obj", "slot"), is.hand_empty(), is_not.holding("obj"), is_not.lifted("obj") },
  continuous = {
    spot = stream(is.in_slot("obj", "slot")),                           -- pose of the object
    clear = { 0.04, min = 0.01, max = 0.15, unit = "m" },               -- how far before the slot the straight way begins
    speed = { 0.05, min = 0.02, max = 0.3, unit = "m/s" },
  },
  label = "put the {obj} into the {slot}",
  verbs = { "insert", "lower", "put", "drop", "stack", "slide", "push", "stand" },
  run = function(robot, p, c)
    local w = robot:view()
    local seated = robot:tip_for(p.obj, c.spot)
    local _, _, depth = w:size(p.slot)
    local x, y, z = w:position(p.slot)
    local ox, oy, oz = w:pose(p.slot):along(0, 0, 1):position()
    local function before(way) return seated:offset((ox - x) * way, (oy - y) * way, (oz - z) * way) end
    robot:move_through {
      { "approach", before(depth + c.clear) }, { "goal", before(depth) },
      { "ahead", seated }, { "ahead", seated:along(0, 0, -0.10) },      -- and back again
    }
    robot:move_line(seated, {
      speed = c.speed, keep_clear = true,                               -- of all but what it goes into
      search = w:number(p.slot, "search"), pitch = w:number(p.slot, "pitch"),
    })
    robot:wait(0.1)
    robot:open_hand()
    robot:retreat(0.10)
  end,
}
