-- Take an object off a shelf through its open front.
return skill {
  params = { "obj: movable & graspable", "shelf: container & shelf" },
  moves = { "obj" },
  precondition = { is.hand_empty(), is.inside("obj", "shelf"), is_not.blocked("shelf") },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.inside("obj", "shelf"), is.lifted("obj") },
  continuous = { grasp = stream("grasps") },                            -- of the object, reachable and free
  label = "take the {obj} off the {shelf}",
  verbs = { "take", "remove" },
  run = function(robot, p, c)
    local w = robot:view()
    local shelf, deep = w:pose(p.shelf), w:size(p.shelf)
    local x, y = shelf:position()
    local far = shelf:inverse():times(w:pose(p.obj)):position() + deep / 2
    local out_x, out_y = shelf:along(-far - 0.01, 0, 0):position()      -- its middle out of the front, the shelf's -x
    out_x, out_y = out_x - x, out_y - y
    robot:open_hand(c.grasp.opening)
    robot:move_through {
      { "approach", c.grasp.approach }, { "grasp", c.grasp.pose }, { "ahead", c.grasp.pose:offset(out_x, out_y, 0.02) },
    }
    robot:close_hand(p.obj, { force = c.grasp.force })
    robot:move_line({ out_x, out_y, 0.02 }, { keep_clear = true })
  end,
}
