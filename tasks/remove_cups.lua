-- Take one or two of the three mugs off the mug tree and put them on the table; the others stay where they hang.
return task {
  variations = { count = { 1, 2 } },
  objects = {
    tree = { "mug_tree", at = on_table { between(0.18, 0.25), between(-0.13, 0.13) },
      yaw = between(-1.6, -0.4) }, -- the first two of its spokes do not point at the robot
    mug = { "mug", count = 3 },
  },
  init = { is.hanging("mug1", "tree.first_spoke"), is.hanging("mug2", "tree.second_spoke"),
    is.hanging("mug3", "tree.third_spoke") },
  goal = function(v)
    return { any_order("mug*", 3, function(mug, i)
      return i <= v.count and is.on(mug[i], "table") or exists("?h: hook", is.hanging(mug[i], "?h"))
    end) }
  end,
  instructions = function(v)
    local what = ({ "one of the mugs", "two of the mugs" })[v.count]
    return {
      "fetch " .. what .. " from the mug tree to the table",
      "stand " .. what .. " that hang there on the table",
      "unhook " .. what .. " from the wooden tree; the table is where mugs go",
      "take " .. what .. " off the tree and set " .. (v.count == 1 and "it" or "them") .. " down on the table",
    }
  end,
}
