-- Press one to three buttons in the order that the instruction says, and no others; a later one before its turn fails.
local function sequences()
  local names, list = colours.names, {}
  for i = 1, 50 do
    local first, round = names[(i - 1) % #names + 1], (i - 1) // #names
    local second = colours.except(first) -- nobody takes one of the three for another
    local b = second[(i + 6 + 3 * round) % #second + 1]
    local third = colours.except(first, b)
    list[#list + 1] = { count = i % 3 + 1, first = first, second = b, third = third[(i + 12 + 5 * round) % #third + 1] }
  end
  return list
end

local words = { "the {first} button", "the {first} button, then the {second} one",
  "the {first} button, then the {second} one, then the {third} one" }

local orders = { "{first}", "{first}, {second}", "{first}, {second}, {third}" }

return task {
  world = "tabletop",
  variations = sequences(),
  objects = function(v)
    local anywhere, turn = { between(0.08, 0.32), between(-0.30, 0.30), 0.75 }, between(-math.pi, math.pi)
    return {
      button1 = { "push_button", colour = v.first, at = anywhere, yaw = turn },
      button2 = { "push_button", colour = v.second, at = anywhere, yaw = turn },
      button3 = { "push_button", colour = v.third, at = anywhere, yaw = turn },
    }
  end,
  init = { is.spaced("button1", "button2"), is.spaced("button1", "button3"), is.spaced("button2", "button3"),
    is_not.pressed("button1.cap"), is_not.pressed("button2.cap"), is_not.pressed("button3.cap") },
  goal = function(v)
    local parts, others = {}, {}
    for i = 1, 3 do
      if i <= v.count then parts[i] = is.pressed("button" .. i .. ".cap") end
      if i > v.count then others[#others + 1] = is_not.pressed("button" .. i .. ".cap") end
    end
    parts[v.count] = all_of { parts[v.count], all_of(others) }
    return in_order(parts)
  end,
  instructions = function(v)
    local what = words[v.count]
    return { "push " .. what, "press down " .. what, "with a fingertip push down " .. what,
      "buttons to press, in this order and no others: " .. orders[v.count] }
  end,
}
