-- Hang one, two or all three mugs that stand on the table on the mug tree.
return task {
  variations = { count = { 1, 2, 3 } },
  objects = {
    tree = { "mug_tree", at = on_table { between(0.10, 0.20), between(-0.15, 0.15) },
      yaw = between(-math.pi / 2, math.pi / 2) },
    mug = { "mug", count = 3 },
  },
  init = { is.on("mug*", "table"), is_not.crowds("tree", "mug*"), is.reachable("mug*") },
  goal = function(v)
    return { any_order("mug*", v.count, function(mug, i)
      return exists("?h: hook", is.hanging(mug[i], "?h"))
    end) }
  end,
  instructions = function(v)
    local what = ({ "one of the mugs", "two of the mugs", "all three mugs" })[v.count]
    return {
      "hang " .. what .. " on the mug tree",
      "the tree is bare: it should bear " .. what,
      "take " .. what .. " off the table and up onto the spokes, by the handle",
      "let " .. what .. " dangle from the wooden tree",
    }
  end,
}
