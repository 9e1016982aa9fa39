-- Take one or two of the three mugs off the mug tree and put them on the table; the others stay where they hang.
local spokes = { "first_spoke", "second_spoke", "third_spoke" }

return task {
  world = "tabletop",
  variations = { count = { 1, 2 } },
  objects = {
    tree = { "mug_tree", at = { between(0.13, 0.20), between(-0.13, 0.13), 0.75 }, yaw = between(-math.pi / 2, math.pi / 2) },
    mug = { "mug", count = 3 },
  },
  init = each(spokes, function(spoke, i) return is.hanging("mug" .. i, "tree." .. spoke) end),
  goal = function(v)
    return { is.hand_empty(), any_order("mug*", 3, function(mug, i)
      return i <= v.count and is.on(mug[i], "table") or exists("?h: hook", is.hanging(mug[i], "?h"))
    end) }
  end,
  instructions = function(v)
    local what = ({ "one of the mugs", "two of the mugs" })[v.count]
    return { "take " .. what .. " off the mug tree and put it on the table" }
  end,
}
