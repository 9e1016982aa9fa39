-- Build a pyramid of the six blocks of one colour on the mat; six of other colours stay where they are.
---@type string[]
local places = { "mat.base1", "mat.base2", "mat.base3", "mat.middle1", "mat.middle2", "mat.top1" }

return task {
  variations = { colour = colours.names },
  objects = {
    mat = { "pyramid_mat", at = on_table { between(0.14, 0.24), between(-0.08, 0.08) }, yaw = between(deg(-22), deg(22)) },
    block = { "cube", colour = "{colour}", count = 6 },
    other = { "cube", colour = one_of(colours.except("{colour}")), count = 6 },
  },
  init = { is.on("block*", "table"), is.on("other*", "table"),
    is.spaced("block*", "mat"), is.spaced("other*", "mat"), is.reachable("block*") },
  goal = {
    any_order("block*", 6, function(b, i) return is.inside(b[i], places[i]) end), -- which block is where is all the same
    stays("other*"),
  },
  horizon = 240, -- s
  instructions = {
    "build a pyramid of the {colour} blocks on the mat",
    "stack the six {colour} cubes: three, then two, then one",
    "make a pyramid out of all {colour} blocks; leave the other colours alone",
    "a pyramid should stand on the mat, {colour} from foot to top",
  },
}
