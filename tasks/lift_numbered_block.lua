-- Lift the block that bears the number; the two others stay where they are.
return task {
  variations = { digit = { 1, 2, 3 } },
  objects = {
    block1 = { "numbered_block_1" },
    block2 = { "numbered_block_2" },
    block3 = { "numbered_block_3" },
    space = { "raised_space", at = { 0.19, 0, 1.05 } },
  },
  init = { is.on("block1", "table"), is.on("block2", "table"), is.on("block3", "table") },
  goal = { is.holding("block{digit}"), is.inside("block{digit}", "space") },
  instructions = {
    "raise the cube marked {digit} well off the table",
    "find the cube that says {digit} and raise it high",
    "of the three blocks hold number {digit} well above the table",
    "only the block numbered {digit} goes high up in the air",
  },
}
