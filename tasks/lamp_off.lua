-- Switch the table lamp, which is lit, off by the button on its foot.
local lamps = require "worlds.lib.lamps"

return task {
  objects = {
    lamp = { "table_lamp", shapes = lamps.shapes(true), at = on_table { between(0.10, 0.30), between(-0.22, 0.22) },
      yaw = between(-math.pi, math.pi) },
  },
  init = { is_not.pressed("lamp.button") },
  goal = is.pressed("lamp.button"),
  instructions = {
    "switch the lamp off",
    "press the button on the foot of the lamp to put it out",
    "the lamp has been left burning: make it dark",
    "nobody needs this lamp now; push its button",
  },
}
