-- Build a pyramid of the six blocks of one colour on the mat; six of other colours stay where they are.
local base = all_of { is.inside("block1", "mat.base1"), is.inside("block2", "mat.base2"), is.inside("block3", "mat.base3") }
local middle = all_of { is.inside("block4", "mat.middle1"), is.inside("block5", "mat.middle2") }

return task {
  world = "tabletop",
  variations = { colour = colours.names },
  objects = function(v)
    return {
      mat = { "pyramid_mat", at = { between(0.14, 0.24), between(-0.08, 0.08), 0.75 }, yaw = between(deg(-22), deg(22)) },
      block = { "cube", colour = v.colour, count = 6 },
      other = { "cube", colour = one_of(colours.except(v.colour)), count = 6 },
    }
  end,
  init = { is.on("block*", "table"), is.on("other*", "table") },
  goal = in_order(base, middle, all_of { base, middle, is.inside("block6", "mat.top1"), is.hand_empty() }),
  horizon = 240, -- s
  instructions = {
    "build a pyramid of the {colour} blocks on the mat",
    "stack the six {colour} cubes: three, then two, then one",
    "make a pyramid out of all {colour} blocks; leave the other colour alone",
    "on the mat a pyramid should stand, {colour} from foot to top",
  },
}
