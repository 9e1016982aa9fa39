-- A block in a drawer; the tests of the task read facts and what is known of them.
return task {
  world = "tabletop",
  variations = { pulled = { 0, 0.16 } }, -- m
  objects = function(v)
    return {
      chest = { "chest", at = { 0.53, 0.14, 0.75 }, joints = { middle_drawer = v.pulled } },
      item = { "cube", at = { 0.53 - v.pulled, 0.14, 0.882 } },
    }
  end,
  goal = is.closed("chest.middle_drawer"),
  also = function(w) return w:fact("inside", "item", "chest.middle_drawer") end,
  fails = function(w) return w:observed("inside", "item", "chest.middle_drawer") end,
  reward = function(w)
    local count = #w:facts("closed")
    if not w:fact("hand_empty") or not w:fact("movable", "item") then count = count + 100 end -- both hold
    if w:fact("holding", "item") or w:facts("closed")[1][2] ~= "chest.bottom_drawer" then count = count + 1000 end
    return count
  end,
  instructions = { "open the drawer" },
}
