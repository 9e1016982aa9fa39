-- Drop the toy basketball through the hoop; the box below the net keeps it.
return task {
  world = "tabletop",
  objects = { hoop = { "basketball_hoop" }, ball = { "basketball" } },
  init = { is.on("hoop", "table"), is.apart("ball", "hoop"), is.on("ball", "table") },
  goal = { is.inside("ball", "hoop"), is.on("hoop", "table"), is.hand_empty() },
  instructions = {
    "put the ball in the hoop",
    "score a basket",
    "drop the basketball through the ring",
    "pick up the orange ball and dunk it",
    "let the ball fall through the net of the basketball stand",
  },
}
