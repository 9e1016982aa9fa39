local function up(n) return n <= 1 and 1 or n * up(n - 1) end
local words = {}
for i, name in ipairs { "cube", "bench" } do words[i] = name:upper():rep(2):gsub("C", "%0%0") end
return task {
  world = "bench",
  objects = { cube = { "cube", at = { 0, 0.1, up(3) / 10 } }, chest = { "chest", at = { 0.3, -0.3, 0.5 } } },
  goal = in_order { is.holding("cube"), is.open("chest.drawer") },
  steps = {
    act.everything("cube", { height = 0.2, push = { 3, 2, 1 }, controller = "joint_position" }),
    act.counting { to = "bench" },
  },
  also = function(w) return w:has_trait("cube", "graspable") and w:attribute("cube", "colour") == "green" end,
  instructions = { "do it", table.concat(words, " ") },
}
