-- Press one to three buttons in the order that the instruction says, and no others; a later one before its turn fails.
local words = { "the {first} button", "the {first} button, then the {second} one",
  "the {first} button, then the {second} one, then the {third} one" }

local anywhere, turn = on_table { between(0.08, 0.32), between(-0.30, 0.30) }, between(-math.pi, math.pi)
local orders = { "{first}", "{first}, {second}", "{first}, {second}, {third}" }

return task {
  variations = each(colours.apart(3, 50), function(c, i) -- nobody takes one of the three for another
    return { count = i % 3 + 1, first = c[1], second = c[2], third = c[3] }
  end),
  objects = {
    button1 = { "push_button", colour = "{first}", at = anywhere, yaw = turn },
    button2 = { "push_button", colour = "{second}", at = anywhere, yaw = turn },
    button3 = { "push_button", colour = "{third}", at = anywhere, yaw = turn },
  },
  init = { is.pairwise("spaced", "button1", "button2", "button3"),
    is_not.pressed("button1.cap"), is_not.pressed("button2.cap"), is_not.pressed("button3.cap") },
  goal = function(v)
    local parts = {}
    for i = 1, v.count do parts[i] = is.pressed("button" .. i .. ".cap") end
    parts[v.count] = all_of { parts[v.count], stays("others") }
    return in_order(parts)
  end,
  instructions = function(v)
    local what = words[v.count]
    return { "push " .. what, "press down " .. what, "with a fingertip push down " .. what,
      "buttons to press, in this order and no others: " .. orders[v.count] }
  end,
}
