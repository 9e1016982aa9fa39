-- The words of the authoring language. Runs once in every state, before any definition file; `api` is C++'s part.
-- Every value that the engine must understand is a table with a field `tag`:
--   definition  { kind = "task" | "skill" | …, line, <the author's fields> }        (kind instead of tag)
--   literal     { tag = "literal", predicate, negated, line, "arg1", … }            is.on("a", "b")
--               with `pairwise`: of each two of the arguments' members; `stays`: what init says, in a goal (`except`: not of these);
--               `implied`: nobody wrote it
--   call        { tag = "call", skill, line, "arg1", …, <named arguments>, set }    act.pick("a", "b", { height = 0.2 })
--   formula     { tag = "all_of" | "any_of" | "in_order", line, part1, … }
--               { tag = "not", line, part }
--               { tag = "forall" | "exists", variables = { "?x: type", … }, line, part }
--               { tag = "any_order", group, n, variables = { "?any1", … }, line, part }
--               { tag = "at_least", group, n, variables = { "?some" }, line, part }
--               { tag = "when", condition, effects, line }                         effects only
--               { tag = "equal", line, "a", "b" }   { tag = "pddl", text, line }
--   place       { tag = "on_table", x, y, above }
--   draw        { tag = "one_of", values }, { tag = "sample_of", values, n }, { tag = "between", low, high }
--   stream      { tag = "stream", source = "grasps", object = "obj" } or { …, source = "sample", literal }
--   shape       { tag = "shape", shape = "box", 1, 2, 3, at, rpy, yaw, colour, … }
--   texture     { tag = "texture", texture = "image", "file.png", size } or { …, texture = "checker", colour, colour }
local api = ...
local setmetatable, here, fail = api.setmetatable, api.here, api.fail
local type, ipairs, pairs, tostring, tonumber, select, math = type, ipairs, pairs, tostring, tonumber, select, math
local words = api.words

local function say(format, ...) fail(string.format(format, ...)) end

-- Definitions -------------------------------------------------------------------------------------------------------
for _, kind in ipairs { "task", "skill", "predicate", "object", "world", "robot" } do
  words[kind] = function(fields)
    if type(fields) ~= "table" then say("%s takes a table: %s { … }", kind, kind) end
    if fields.kind ~= nil then say("a %s has no field 'kind'", kind) end
    if fields.line ~= nil then say("a %s has no field 'line'", kind) end
    fields.kind, fields.line = kind, here()
    return fields
  end
end

local function listed(value)
  if value == nil then return {} end
  if type(value) ~= "table" or value.tag ~= nil then return { value } end
  return value
end

local function joined(first, second)
  if first == nil and second == nil then return nil end
  local result = {}
  for _, value in ipairs(listed(first)) do result[#result + 1] = value end
  for _, value in ipairs(listed(second)) do result[#result + 1] = value end
  return result
end

local function with_conditions(fields, own)
  local result = {}
  for key, value in pairs(fields) do result[key] = value end
  result.precondition = joined(fields.precondition, own.precondition)
  result.effect = joined(fields.effect, own.effect)
  return result
end

local function together(first, second)
  local result = {}
  for _, fields in ipairs { first or {}, second or {} } do
    for name, value in pairs(fields) do result[name] = value end
  end
  return result
end

local function take_rest(own, base)
  for key, value in pairs(base) do
    if own[key] == nil and key ~= "extends" and key ~= "replaces" then own[key] = value end
  end
end

-- A skill that extends another: gets what it leaves out; conditions and effects add up, with cases: in each.
local extend = {}
function extend.skill(own, base)
  if own.cases ~= nil then say("a skill that extends another has no cases of its own") end
  if base.cases ~= nil then
    own.cases = {}
    for name, case in pairs(base.cases) do own.cases[name] = with_conditions(case, own) end
    own.precondition, own.effect = nil, nil
  else
    own.precondition, own.effect = joined(base.precondition, own.precondition), joined(base.effect, own.effect)
  end
  own.continuous, own.reads = together(base.continuous, own.continuous), together(base.reads, own.reads)
  take_rest(own, base)
end

-- Of two tests both; of their margins the lesser, where the first says one.
local function both(first, second)
  return function(...)
    local held, margin = first(...)
    if not held then return false, margin end
    local also, other = second(...)
    if margin == nil then return also end
    return also, math.min(margin, other or also and margin or 0)
  end
end

-- A predicate that extends another: gets what it leaves out, and holds where that one holds and its own test too.
function extend.predicate(own, base)
  if own.params ~= nil and #own.params ~= #(base.params or {}) then
    say("params: it takes as many things as '%s', which it extends: %d", own.extends, #(base.params or {}))
  end
  if own.derived ~= nil and base.derived ~= nil then own.derived = { tag = "all_of", line = own.line, base.derived, own.derived } end
  if (own.derived ~= nil) ~= (base.derived ~= nil) and (own.holds ~= nil or own.derived ~= nil) then
    say("'%s', which it extends, is made with %s: this one too", own.extends, base.derived and "derived" or "holds")
  end
  if own.holds ~= nil and base.holds ~= nil then own.holds = both(base.holds, own.holds) end
  own.reads = together(base.reads, own.reads)
  take_rest(own, base)
end
function api.extend(own, base) extend[own.kind](own, base) end

-- Literals and calls --------------------------------------------------------------------------------------------------
local nothing = { tag = "nothing" } -- b[0] of any_order: a literal that names it is left out

local function literal(predicate, negated)
  return function(...)
    local value = { tag = "literal", predicate = predicate, negated = negated, line = here() }
    for i = 1, select("#", ...) do
      local argument = (select(i, ...))
      if argument == nothing then return { tag = "all_of", line = here() } end
      if type(argument) ~= "string" then
        say("%s: argument %d is a %s, arguments are names such as \"cup\" or \"?x\"", predicate, i, type(argument))
      end
      value[i] = argument
    end
    return value
  end
end

local function by_name(make)
  local made = {}
  return function(_, name)
    if type(name) ~= "string" then say("a name is text, this is a %s", type(name)) end
    if made[name] == nil then made[name] = make(name) end
    return made[name]
  end
end

local function fixed(_, name) say("'%s' cannot be assigned here: it follows from a file", tostring(name)) end

local function is_value(value)
  return type(value) == "table" and (type(value.tag) == "string")
end

local function one_part(word, part)
  if not is_value(part) then say("%s takes a literal or formula, this is a %s", word, type(part)) end
  return part
end

local function parts_of(tag, ...)
  local list = { ... }
  if #list == 1 and type(list[1]) == "table" and list[1].tag == nil then list = list[1] end -- any_of { … } or any_of(…)
  local value = { tag = tag, line = here() }
  for i = 1, #list do value[i] = one_part(tag, list[i]) end
  return value
end

-- is.pairwise("apart", "cup*", "plate"): of each two of them, in the order in which they are named.
local function pairwise(negated)
  return function(predicate, ...)
    if type(predicate) ~= "string" or select("#", ...) == 0 then
      say("pairwise takes a predicate and what it is said of: is.pairwise(\"apart\", \"cup*\")")
    end
    local value = literal(predicate, negated)(...)
    value.pairwise = true
    return value
  end
end

words.is = setmetatable({ pairwise = pairwise(false) }, { __index = by_name(function(name) return literal(name, false) end), __newindex = fixed })
words.is_not = setmetatable({ pairwise = pairwise(true) }, {
  __index = by_name(function(name) return literal(name, true) end),
  __newindex = fixed,
  __call = function(_, part) return { tag = "not", line = here(), one_part("is_not", part) } end,
})
words.act = setmetatable({}, {
  __index = by_name(function(name)
    return function(...)
      local value = { tag = "call", skill = name, line = here() }
      local list = { ... }
      if #list == 1 and type(list[1]) == "table" then list = list[1] end -- act.place{ "cup", to = "shelf" }
      local set = {}
      if type(list[#list]) == "table" then -- act.pick("cup", { height = 0.2 })
        for key, choice in pairs(list[#list]) do set[key] = choice end
        list[#list] = nil
      end
      for key, argument in pairs(list) do
        if type(key) == "string" and (key == "controller" or type(argument) ~= "string") then
          set[key] = argument
        elseif type(argument) ~= "string" then
          say("%s: arguments are names of objects, '%s' is a %s", name, key, type(argument))
        else
          value[key] = argument
        end
      end
      for _ in pairs(set) do value.set = set end -- `next` is not for scripts
      return value
    end
  end),
  __newindex = fixed,
})

-- Formulas ------------------------------------------------------------------------------------------------------------
function words.all_of(...) return parts_of("all_of", ...) end
function words.any_of(...) return parts_of("any_of", ...) end
function words.in_order(...) return parts_of("in_order", ...) end
function words.equal(a, b) return { tag = "equal", line = here(), a, b } end
function words.pddl(text) return { tag = "pddl", text = text, line = here() } end

-- exists("?x: block", "?y: block", formula); the formula may be a function of the variables' names.
local function quantified(tag, ...)
  local value = { tag = tag, line = here(), variables = {} }
  local count = select("#", ...)
  local part = (select(count, ...))
  local names = {}
  for i = 1, count - 1 do
    local variable = (select(i, ...))
    if type(variable) ~= "string" then say("%s: write variables as \"?x: type\"", tag) end
    value.variables[i] = variable
    local colon = string.find(variable, ":")
    names[i] = colon and string.sub(variable, 1, colon - 1) or variable
  end
  if count < 2 then say("%s takes variables and a formula: %s(\"?x: movable\", is.on(\"?x\", \"table\"))", tag, tag) end
  if type(part) == "function" then part = part(table.unpack(names)) end
  if type(part) == "table" and part.tag == nil then part = parts_of("all_of", part) end
  value[1] = one_part(tag, part)
  return value
end
function words.forall(...) return quantified("forall", ...) end
function words.exists(...) return quantified("exists", ...) end

-- n distinct members of the group, in some order, such that f(b, i) holds for i = 1 … n. b[i] is the i-th of them;
-- a literal that names b[0] is left out, so that chains are written without a special case.
function words.any_order(group, n, f)
  if type(group) ~= "string" or type(f) ~= "function" or math.type(n) ~= "integer" or n < 1 then
    say("any_order takes a group, a whole number and a function: any_order(\"block*\", 2, function(b, i) … end)")
  end
  if n > 8 then say("any_order chooses at most 8 members, not %d", n) end
  local value = { tag = "any_order", group = group, n = n, variables = {}, line = here() }
  local b = { [0] = nothing }
  for i = 1, n do
    b[i] = "?any" .. i
    value.variables[i] = b[i]
  end
  local part = { tag = "all_of", line = here() }
  for i = 1, n do part[i] = one_part("any_order", f(b, i)) end
  value[1] = part
  return value
end

function words.at_least(n, group, f)
  if type(group) ~= "string" or type(f) ~= "function" or math.type(n) ~= "integer" or n < 1 then
    say("at_least takes a whole number, a group and a function: at_least(4, \"bean*\", function(x) … end)")
  end
  local value = { tag = "at_least", group = group, n = n, variables = { "?some" }, line = here() }
  value[1] = one_part("at_least", f("?some"))
  return value
end

-- Goals ----------------------------------------------------------------------------------------------------------------
-- stays("cup", "box"): what `init` says of them, and of their parts, holds at the end too, but for what is asked of starts
-- alone; stays("others"): of all that the goal does not speak of.
function words.stays(...)
  local value = { tag = "stays", line = here() }
  for i = 1, select("#", ...) do
    local name = (select(i, ...))
    if type(name) ~= "string" then say("stays takes names of things, this is a %s", type(name)) end
    value[i] = name
  end
  if #value == 0 then say("stays takes names of things: stays(\"cup\"), stays(\"others\")") end
  return value
end

-- Calls visit(node) for each literal and each stays of a formula or list of them, also inside others.
local function each_literal(node, visit)
  if type(node) ~= "table" then return end
  if node.tag == "literal" or node.tag == "stays" then return visit(node) end
  for i = 1, #node do each_literal(node[i], visit) end
end

local function has(node, test)
  local found = false
  each_literal(node, function(one) found = found or test(one) end)
  return found
end
local function is_stays(one) return one.tag == "stays" end

local function begins(name, with) return string.sub(name, 1, #with) == with end
local function belongs(name, to) return name == to or begins(name, to .. ".") end
local function member(name, group)
  local stem = string.sub(group, 1, -2)
  local rest = string.sub(name, #stem + 1)
  local dot = string.find(rest, ".") -- finds plain text
  return string.sub(group, -1) == "*" and begins(name, stem) and tonumber(dot and string.sub(rest, 1, dot - 1) or rest) ~= nil
end

-- What the goal speaks of.
local function names_in(goal)
  local names = {}
  each_literal(goal, function(one)
    for i = 1, one.tag == "literal" and #one or 0 do names[#names + 1] = one[i] end
  end)
  return names
end

-- Whether a literal of `init` is of the others, and which members of the group that it names are none of them.
local function of_others(of, spoken)
  local except = {}
  for _, name in ipairs(spoken) do
    if belongs(of, name) or belongs(name, of) or member(of, name) then return false end
    if member(name, of) then except[#except + 1] = name end
  end
  return true, except
end

-- The literals of `init` that a stays stands for.
local function staying(stays, spoken, init)
  local kept = {}
  for i = 1, #stays do
    local name, found = stays[i], stays[i] == "others"
    each_literal(init, function(one)
      local of = one[1]
      if of == nil or one.pairwise then return end
      local meant, except = belongs(of, name), nil
      if name == "others" then meant, except = of_others(of, spoken) end
      if not meant then return end
      found = true
      local copy = { tag = "literal", predicate = one.predicate, negated = one.negated, line = stays.line, stays = true,
        except = except }
      for k = 1, #one do copy[k] = one[k] end
      kept[#kept + 1] = copy
    end)
    if not found then say("stays(\"%s\"): init says nothing of '%s' that could stay", name, name) end
  end
  return kept
end

local function with_staying(node, spoken, init)
  if type(node) ~= "table" or node.tag == "literal" then return node end
  local copy = {}
  if is_stays(node) then
    copy = staying(node, spoken, init)
    copy.tag, copy.line = "all_of", node.line
    return copy
  end
  for key, value in pairs(node) do
    if math.type(key) ~= "integer" then copy[key] = value end
  end
  for i = 1, #node do
    local part = with_staying(node[i], spoken, init)
    local spread = type(node[i]) == "table" and is_stays(node[i]) and (node.tag == nil or node.tag == "all_of")
    for k = 1, spread and #part or 1 do copy[#copy + 1] = spread and part[k] or part end
  end
  return copy
end

-- The hand is to be empty at the end, unless the task says hand = "any" or the goal speaks of the hand itself, or (see
-- formula_reader) of what it holds.
local function with_empty_hand(goal)
  local function speaks_of_it(one) return one.predicate == "hand_empty" end
  if type(goal) ~= "table" or #goal == 0 or has(goal, speaks_of_it) then return goal end
  local empty = { tag = "literal", predicate = "hand_empty", negated = false, line = goal.line, implied = true }
  local whole = goal.tag == nil and #goal == 1 and type(goal[1]) == "table" and goal[1] or goal
  if whole.tag ~= "in_order" and goal.tag ~= nil then return { tag = "all_of", line = goal.line, goal, empty } end
  local parts = {}
  for key, value in pairs(whole.tag == "in_order" and whole or goal) do parts[key] = value end
  if whole.tag == "in_order" then
    parts[#parts] = { tag = "all_of", line = whole.line, parts[#parts], empty }
  else
    parts[#parts + 1] = empty
  end
  return parts
end

-- Names with {axis} in them: "chest.{level}_drawer", with the variation's value for it. A text that is {axis} and no
-- more is the value itself.
local function with_axes(text, v)
  local open = string.find(text, "{")
  local close = open and string.find(text, "}", open)
  if not close then return text end
  local axis, value = string.sub(text, open + 1, close - 1), nil
  for name, chosen in pairs(v) do -- v[axis] would speak of a place in here
    if name == axis then value = chosen end
  end
  if value == nil then say("'%s': there is no axis '%s'", text, axis) end
  if open == 1 and close == #text then return value end
  return string.sub(text, 1, open - 1) .. tostring(value) .. with_axes(string.sub(text, close + 1), v)
end

local function has_axes(node, depth)
  if type(node) == "string" then return string.find(node, "{") ~= nil end
  if type(node) ~= "table" or depth > 32 then return false end -- deeper: the reader says
  for _, value in pairs(node) do
    if has_axes(value, depth + 1) then return true end
  end
  return false
end

-- `but_sentences`: texts that stand in no formula are left alone, they are sentences of subgoals.
local function filled(node, v, but_sentences)
  if type(node) == "string" then return but_sentences and node or with_axes(node, v) end
  if type(node) ~= "table" then return node end
  local copy, outside = {}, but_sentences and node.tag == nil
  for key, value in pairs(node) do copy[key] = filled(value, v, outside) end
  if copy.tag == "except" then return words.colours.except(table.unpack(copy)) end
  if copy.tag == "sample_of" and copy.n > #copy.values then say("sample_of draws %d of %d values", copy.n, #copy.values) end
  return copy
end

local define_task = words.task
function words.task(fields)
  local definition = define_task(fields)
  if definition.world == nil then definition.world = "tabletop" end
  for _, name in ipairs { "objects", "init", "told", "goal", "steps", "subgoals" } do
    local field = definition[name]
    if has_axes(field, 1) then definition[name] = function(v) return filled(field, v, name == "subgoals") end end
  end
  local goal, init = definition.goal, definition.init
  local implied = api.hand_empty and definition.hand ~= "any"
  local function finished(what, v)
    if has(what, is_stays) then
      local start = init
      if type(init) == "function" then start = init(v) end
      what = with_staying(what, names_in(what), start)
    end
    return implied and with_empty_hand(what) or what
  end
  if type(goal) == "function" then
    definition.goal = function(v) return finished(goal(v), v) end
  elseif has(goal, is_stays) and type(init) == "function" then
    definition.goal = function(v) return finished(goal, v) end
  else
    definition.goal = finished(goal)
  end
  return definition
end

-- Effects and streams -------------------------------------------------------------------------------------------------
function words.when(condition, effects)
  if is_value(effects) then effects = { effects } end
  if type(effects) ~= "table" then say("when takes a condition and a list of effects") end
  return { tag = "when", condition = one_part("when", condition), effects = effects, line = here() }
end

-- stream("grasps") or stream("grasps", "obj"); stream("grasps", "part", "pull"): with which the hand can take the part to
-- the joint position that its number `pull` says; stream(is.on("obj", "to")): the predicate's sample.
function words.stream(source, object, to)
  if source == "sample" then source = object end -- stream("sample", is.on("obj", "to"))
  if source == "grasps" then return { tag = "stream", source = "grasps", object = object, to = to, line = here() } end
  if is_value(source) and source.tag == "literal" then
    return { tag = "stream", source = "sample", literal = source, line = here() }
  end
  say("stream takes \"grasps\" or a literal such as is.on(\"obj\", \"to\")")
end

-- at = on_table { x, y }: on the top of the world's table, or `above` it: on_table { x, y, 0.2 }.
function words.on_table(fields, ...)
  if type(fields) ~= "table" then fields = { fields, ... } end
  if #fields < 2 or #fields > 3 then say("on_table takes x and y, and how far above the table: on_table { 0.2, 0.1 }") end
  for i = 1, #fields do
    local draws = type(fields[i]) == "table" and type(fields[i].tag) == "string"
    if type(fields[i]) ~= "number" and not draws then
      say("on_table: value %d is a %s, it takes numbers in m: on_table { 0.2, 0.1 }", i, type(fields[i]))
    end
  end
  return { tag = "on_table", line = here(), fields[1], fields[2], fields[3] }
end

local draw = {} -- the metatable of draws: who reckons with one is told what it is
for _, operator in ipairs { "__add", "__sub", "__mul", "__div", "__mod", "__pow", "__idiv", "__unm", "__concat", "__lt", "__le", "__len" } do
  draw[operator] = function(a, b)
    local word = type(a) == "table" and a.tag or b.tag
    local cure = word == "between" and "Reckon with its bounds: between(low + 0.1, high + 0.1)"
      or string.format("Reckon with each of its values before it draws: %s(each(list, function(x) return x + 0.1 end)%s)", word,
        word == "sample_of" and ", n" or "")
    say("%s(…) has no value yet: it is drawn in each episode, anew wherever it stands. %s", word, cure)
  end
end
local function drawn(fields) return setmetatable(fields, draw) end

-- Draws, per episode ----------------------------------------------------------------------------------------------------
function words.one_of(...)
  local values = { ... }
  if #values == 1 and type(values[1]) == "table" and (values[1].tag == nil or values[1].tag == "except") then values = values[1] end
  if #values == 0 then say("one_of draws from nothing") end
  return drawn { tag = "one_of", values = values, line = here() }
end
function words.sample_of(values, n)
  if type(values) ~= "table" or math.type(n) ~= "integer" then say("sample_of takes a list and a whole number") end
  if n > #values and values.tag ~= "except" then say("sample_of draws %d of %d values", n, #values) end
  return drawn { tag = "sample_of", values = values, n = n, line = here() }
end
function words.between(low, high)
  if type(low) ~= "number" or type(high) ~= "number" or not (low <= high) then
    say("between takes two numbers, the lower one first")
  end
  return drawn { tag = "between", low = low, high = high, line = here() }
end

-- Shapes ----------------------------------------------------------------------------------------------------------------
for _, shape in ipairs { "box", "sphere", "cylinder", "capsule", "cone", "hull", "lathe", "mesh" } do
  words[shape] = function(fields, ...)
    if type(fields) ~= "table" then fields = { fields, ... } end -- box(0.1, 0.1, 0.1) is box { 0.1, 0.1, 0.1 }
    fields.tag, fields.shape, fields.line = "shape", shape, here()
    return fields
  end
end

-- Textures ----------------------------------------------------------------------------------------------------------------
for word, kind in pairs { texture = "image", checker = "checker", stripes = "stripes", noise = "noise" } do
  words[word] = function(fields, ...)
    if type(fields) ~= "table" then fields = { fields, ... } end
    fields.tag, fields.texture, fields.line = "texture", kind, here()
    return fields
  end
end

-- Helpers -----------------------------------------------------------------------------------------------------------------
words.deg = math.rad -- deg(40) is 40 degrees in radians
words.mm = function(x) return x / 1000 end
words.cm = function(x) return x / 100 end

-- A skill's whole run: run = policy("grasp_net", { seconds = 5 })
function words.policy(name, options)
  if type(name) ~= "string" or name == "" then say("policy takes the name under which it is registered") end
  return function(robot) robot:policy(name, options) end
end

-- each(list, f): the list of f(value, index); in Lua, so that f may contain robot calls.
function words.each(list, f)
  local result = {}
  for i, value in ipairs(list) do result[#result + 1] = f(value, i) end
  return result
end

function words.range(first, last, step)
  local result = {}
  for i = first, last, step or 1 do result[#result + 1] = i end
  return result
end

-- colours: worlds/colours.lua returns { red = { 0.9, 0.1, 0.1 }, … } (sRGB, 0 … 1); names are in alphabetical order.
local colours = {}
local by_colour, colour_names = {}, {}
for name, rgb in pairs(api.colours) do
  colour_names[#colour_names + 1] = name
  by_colour[name] = rgb
end
function colours.rgb(name)
  local rgb = by_colour[name]
  if rgb == nil then say("there is no colour '%s' in worlds/colours.lua", tostring(name)) end
  return { rgb[1], rgb[2], rgb[3] }
end

-- CIELAB under D65 (IEC 61966-2-1, CIE 15).
local labs = {}
local function lab_of(name)
  local lab = labs[name]
  if lab then return lab end
  local linear = colours.rgb(name)
  for i = 1, 3 do
    local v = linear[i]
    linear[i] = v <= 0.04045 and v / 12.92 or ((v + 0.055) / 1.055) ^ 2.4
  end
  local r, g, b = linear[1], linear[2], linear[3]
  local function f(t) return t > 216 / 24389 and t ^ (1 / 3) or (24389 / 27 * t + 16) / 116 end
  local x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047)
  local y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b)
  local z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883)
  lab = { 116 * y - 16, 500 * (x - y), 200 * (y - z) }
  labs[name] = lab
  return lab
end

-- How different two colours look: CIEDE2000 (Sharma, Wu, Dalal 2005, doi:10.1002/col.20070).
function colours.difference(first, second)
  local p, q = lab_of(first), lab_of(second)
  local sqrt, sin, cos, rad, pi = math.sqrt, math.sin, math.cos, math.rad, math.pi
  local function length(a, b) return sqrt(a * a + b * b) end
  local mean = (length(p[2], p[3]) + length(q[2], q[3])) / 2
  local stretch = 1 + 0.5 * (1 - sqrt(mean ^ 7 / (mean ^ 7 + 25 ^ 7)))
  local function polar(lab)
    local a = lab[2] * stretch
    local hue = math.atan(lab[3], a)
    return length(a, lab[3]), hue < 0 and hue + 2 * pi or hue
  end
  local c1, h1 = polar(p)
  local c2, h2 = polar(q)
  local grey = c1 * c2 == 0
  local turn, hue = h2 - h1, (h1 + h2) / 2
  if math.abs(turn) > pi then
    turn, hue = turn > 0 and turn - 2 * pi or turn + 2 * pi, (hue + pi) % (2 * pi)
  end
  if grey then turn, hue = 0, h1 + h2 end
  local lightness, chroma = (p[1] + q[1]) / 2, (c1 + c2) / 2
  local t = 1 - 0.17 * cos(hue - rad(30)) + 0.24 * cos(2 * hue) + 0.32 * cos(3 * hue + rad(6)) - 0.20 * cos(4 * hue - rad(63))
  local far = (lightness - 50) ^ 2
  local dl = (q[1] - p[1]) / (1 + 0.015 * far / sqrt(20 + far))
  local dc = (c2 - c1) / (1 + 0.045 * chroma)
  local dh = 2 * sqrt(c1 * c2) * sin(turn / 2) / (1 + 0.015 * chroma * t)
  local spread = rad(60) * math.exp(-((math.deg(hue) - 275) / 25) ^ 2)
  local rotation = -2 * sqrt(chroma ^ 7 / (chroma ^ 7 + 25 ^ 7)) * sin(spread)
  return sqrt(dl * dl + dc * dc + dh * dh + rotation * dc * dh)
end

-- Colours nearer than this are taken for one another, in shade or by name: cyan and azure are 31.8 apart.
local confused = 32
function colours.except(...)
  local others = {}
  if has_axes({ ... }, 1) then return { tag = "except", ... } end -- filled() asks again
  for _, name in ipairs { ... } do
    for _, one in ipairs(type(name) == "table" and name or { name }) do others[#others + 1] = one end
  end
  local result = {}
  for _, name in ipairs(colour_names) do
    local apart = true
    for _, other in ipairs(others) do
      apart = apart and name ~= other and (by_colour[other] == nil or colours.difference(name, other) >= confused)
    end
    if apart then result[#result + 1] = name end
  end
  return result
end
-- colours.apart(3, 50): 50 lists of three that nobody takes for one another (default: as many as there are colours), each
-- colour as often the first as any other.
function colours.apart(n, count)
  if math.type(n) ~= "integer" or n < 1 or (count ~= nil and (math.type(count) ~= "integer" or count < 1)) then
    say("colours.apart takes how many colours, and how many lists of them: colours.apart(3, 50)")
  end
  local lists, names = {}, colour_names
  for i = 1, count or #names do
    local list, round = { names[(i - 1) % #names + 1] }, (i - 1) // #names
    for k = 2, n do
      local left = colours.except(list)
      if #left == 0 then say("colours.apart: there are no %d colours that far apart", n) end
      list[k] = left[(i + 6 * (k - 1) + (2 * k - 1) * round) % #left + 1]
    end
    lists[i] = list
  end
  return lists
end
words.colours = setmetatable({}, {
  __index = function(_, name)
    if name == "names" then return { table.unpack(colour_names) } end -- who sorts it sorts his own
    return colours[name]
  end,
  __newindex = fixed,
})
