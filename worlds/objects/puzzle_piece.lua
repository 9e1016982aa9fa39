-- The loose piece of a wooden puzzle for small children: 9 mm thick, with a grip on top; its frame is at its underside.
local cutouts = require "worlds.lib.cutouts"

local thick, grip = 0.009, 0.018 -- m
local shapes = cutouts.solid(require "worlds.lib.puzzle_outline", 0, thick)
shapes[#shapes + 1] = box { grip, grip, 0.026, at = { 0, 0, thick + 0.013 }, colour = { 0.90, 0.76, 0.50 } }

local grasps = {} -- the grip between the fingers, from above
for turn = 0, 3 do
  grasps[#grasps + 1] = { at = { 0, 0, thick + 0.014 }, rpy = { math.pi, 0, turn * math.pi / 2 }, width = grip,
    approach = 0.08, force = 30 }
end

return object {
  type = "puzzle_piece", traits = { "movable", "graspable" }, mass = 0.05, friction = 0.5, colour = "orange",
  shapes = shapes, grasps = grasps,
  regions = { seat = { size = { 0.002, 0.002, 0.002 } } },
}
