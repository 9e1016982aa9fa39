-- As the pick that ships, but its body is a policy that was learned; see ../../learned_skill.py.
return skill {
  params = { "obj: movable & graspable", "from: support" },
  precondition = { is.hand_empty(), is.on("obj", "from"), is_not(exists("?y: movable", is.on("?y", "obj"))) },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.on("obj", "from"), is.lifted("obj") },
  label = "pick up the {obj}",
  run = policy("cloned_pick", { seconds = 8, until_effect = false }),
}
