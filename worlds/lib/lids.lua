-- Lids on a level hinge, with a grip at the front to swing them by: what a box, a toilet and a barbecue have in common.
local lids = {}

-- A hand that takes a grip at { x, y, z } by its two ends, the fingers along y; from straight above the shut lid (0
-- degrees) or from behind or before it. The grip is round, so the hand may turn about it while the lid swings.
function lids.grasps(x, y, z, width)
  local list = {}
  for _, degrees in ipairs { 0, 25, -25, 50, -50, -75, -100, -125 } do
    for _, side in ipairs { 1, -1 } do
      list[#list + 1] = { at = { x, y, z }, width = width, approach = 0.07, force = 40,
        rpy = { math.pi, side * math.rad(degrees), side > 0 and 0 or math.pi } }
    end
  end
  return list
end

-- The grip alone: a round bar across the front of what is `front` m before the hinge, 25 mm off it on a neck.
function lids.grip(front, z, y, colour)
  return cylinder { 0.009, 0.030, at = { -front - 0.025, y or 0, z }, rpy = { math.pi / 2, 0, 0 }, colour = colour },
    box { 0.020, 0.010, 0.010, at = { -front - 0.010, y or 0, z }, colour = colour }
end

-- A lid that is level, shut, and reaches from its hinge, the y axis of its frame, towards -x. `shapes`: what it is made of;
-- `front`: how far it reaches; `grip`: the height of the grip, and its y. Open from `open` degrees on, shut up to `closed`, 1.
function lids.lid(fields)
  local y = fields.grip.y or 0
  local lid = {
    type = "lid", traits = { "openable" }, mass = fields.mass, colour = fields.colour, friction = 0.7,
    hinge = { axis = { 0, 1, 0 }, at = fields.at, range = { 0, math.rad(fields.most or 110) }, friction = fields.friction or 0.25, damping = 0.1 },
    numbers = { open_at = math.rad(fields.open), closed_at = math.rad(fields.closed or 1), pull = math.rad(fields.open + 8), pivot = 2.2, gripped = 1 },
    shapes = fields.shapes,
    grasps = lids.grasps(-fields.front - 0.025, y, fields.grip.z, 0.030),
  }
  local bar, neck = lids.grip(fields.front, fields.grip.z, y, fields.grip.colour)
  lid.shapes[#lid.shapes + 1] = bar
  lid.shapes[#lid.shapes + 1] = neck
  return lid
end

-- The flap of an oven: upright, shut, its foot the y axis of its frame; it swings down towards -x until it is level. Its bar
-- stands before its upper edge, where the hand can follow it down from above.
function lids.flap(fields)
  local width, height, thick = fields.width, fields.height, 0.018
  local bar_x, bar_z = -thick - 0.020, height + 0.012
  local grip = { 0.25, 0.25, 0.27 }
  local flap = {
    type = "door", traits = { "openable" }, mass = fields.mass or 1.0, colour = fields.colour, friction = 0.7,
    hinge = { axis = { 0, -1, 0 }, at = fields.at, range = { 0, math.rad(90) }, friction = 0.6, damping = 0.3 },
    numbers = { open_at = math.rad(80), closed_at = math.rad(1), pull = math.rad(88), pivot = 2.2, gripped = 1 },
    shapes = {
      box { thick, width, height, at = { -thick / 2, 0, height / 2 } },
      cylinder { 0.009, 0.030, at = { bar_x, 0, bar_z }, rpy = { math.pi / 2, 0, 0 }, colour = grip },
      box { 0.026, 0.010, 0.010, at = { -thick - 0.008, 0, bar_z - 0.010 }, rpy = { 0, math.rad(40), 0 }, colour = grip },
    },
    grasps = lids.grasps(bar_x, 0, bar_z, 0.030),
  }
  for _, shape in ipairs(fields.shapes or {}) do flap.shapes[#flap.shapes + 1] = shape end
  return flap
end

return lids
