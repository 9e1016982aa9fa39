-- Unscrew the lid of the jar of one colour and put it on the table; the other jar stays shut.
local anywhere = on_table { between(0.08, 0.32), between(-0.28, 0.28) }

return task {
  variations = { colour = colours.names },
  objects = {
    jar = { "jar", colour = "{colour}", at = anywhere, yaw = between(-math.pi, math.pi) },
    other = { "jar", colour = one_of(colours.except("{colour}")), at = anywhere, yaw = between(-math.pi, math.pi) },
  },
  init = { is.spaced("jar", "other"), is.joined("jar.lid"), is.joined("other.lid") },
  goal = { is.on("jar.lid", "table"), stays("others") },
  instructions = {
    "open the {colour} jar",
    "unscrew the lid of the {colour} jar and put it on the table",
    "take the lid off the {colour} jar; leave the other jar shut",
    "twist the {colour} jar open and lay its lid down",
  },
}
