-- Pick up the block of one colour and hold it in the zone in the air; two other blocks stay where they are.
return task {
  variations = { colour = colours.names },
  objects = {
    target = { "cube", colour = "{colour}" },
    other = { "cube", colour = one_of(colours.except("{colour}")), count = 2 },
    zone = { "air_zone", at = { between(0.10, 0.28), between(-0.22, 0.22), between(0.95, 1.10) } },
  },
  init = { is.on("target", "table"), is.on("other*", "table") },
  goal = { is.holding("target"), is.inside("target", "zone") },
  hold = 0.5, -- s
  instructions = {
    "carry the {colour} block up into the green zone and keep it there",
    "hold the {colour} cube inside the green box in the air",
    "raise the {colour} cube into the marked space",
    "take the {colour} block from the table to the floating zone",
  },
}
