-- Take the stick and drag the cube with it onto the patch of one colour; two patches of other colours are there to be ignored.
local anywhere, turn = on_table { between(0.04, 0.32), between(-0.28, 0.28) }, between(-math.pi, math.pi)

return task {
  variations = { colour = colours.names },
  objects = {
    target = { "patch", colour = "{colour}", at = anywhere, yaw = turn },
    other = { "patch", count = 2, colour = sample_of(colours.except("{colour}"), 2), at = anywhere, yaw = turn },
    cube = { "waxed_cube", at = on_table { between(0.04, 0.32), between(-0.28, 0.28), 0.031 }, yaw = turn },
    stick = { "stick" },
  },
  init = { is.pairwise("spaced", "target", "other*"),
    is.on("cube", "table"), is.outside("cube", "target"), is.on("stick", "table"), is_not.crowds("cube", "stick") },
  goal = { is.covers("cube", "target"), is.on("cube", "table") },
  hand = "any",
  also = function(w) return w:at_rest("cube") end,
  instructions = {
    "drag the cube onto the {colour} patch with the stick",
    "use the stick to bring the cube to the {colour} square",
    "the hand must not touch the cube: take the stick and pull it to where the table is {colour}",
    "reach for the stick and shift the cube with it until it lies on {colour}",
  },
}
