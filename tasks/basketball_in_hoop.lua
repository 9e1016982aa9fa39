-- Drop the toy basketball through the hoop; the box below the net keeps it.
return task {
  objects = { hoop = { "basketball_hoop" }, ball = { "basketball" } },
  init = { is.on("hoop", "table"), is.apart("ball", "hoop"), is.on("ball", "table"), is.reachable("ball") },
  goal = { is.inside("ball", "hoop"), stays("hoop") },
  instructions = {
    "score with the toy basketball",
    "send the basketball down through the net and into the box",
    "hold the orange ball over the ring and let go",
    "get the basketball through the hoop and into its box",
  },
}
