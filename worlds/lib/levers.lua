-- Doors and windows in a frame that a lever holds shut: the lever must be turned before they swing.
local levers = {}

local brass = { 0.72, 0.60, 0.30 }

-- Hands that point along +x, from some degrees above and beside, their closing axis upright (`across` false) or level.
local function hands(downs, besides, across)
  local list = {}
  for _, down in ipairs(downs) do
    for _, beside in ipairs(besides) do
      local d, yaw = math.rad(down), math.rad(beside)
      if across then
        list[#list + 1] = { 0, math.pi / 2 + d, yaw }
        list[#list + 1] = { 0, -math.pi / 2 - d, yaw + math.pi }
      else
        list[#list + 1] = { math.pi / 2 + d, 0, yaw + math.pi / 2 }
        list[#list + 1] = { -math.pi / 2 - d, 0, yaw - math.pi / 2 }
      end
    end
  end
  return list
end

-- Grasps of a lever, one finger on either side: above and below it, or left and right of one that hangs.
local function grasps(at, hanging)
  local list = {}
  for _, rpy in ipairs(hands({ 0, 15, 30, 45 }, { 0, 15, -15, 30, -30, 45, -45 }, hanging)) do
    list[#list + 1] = { at = at, rpy = rpy, width = 0.016, approach = 0.08, force = 50 }
  end
  return list
end

-- A leaf that closes an opening which looks along -x and reaches from y = 0, where its hinge is, to y = `width`; it opens towards
-- -x. `lever`: the name of the part that `levers.lever` makes for it, at height `lever_z`, whose turn of `free` rad
-- frees it; `hanging`: that hangs down when the leaf is shut.
function levers.leaf(fields)
  local width, height, thick = fields.width, fields.height, fields.thick or 0.024
  local leaf = {
    type = fields.type or "door", traits = { "openable" }, mass = fields.mass or 2.0, colour = fields.colour,
    attributes = { lever = fields.lever },
    hinge = { axis = { 0, 0, 1 }, at = fields.at, range = { 0, math.rad(90) }, friction = 0.4, damping = 0.3,
      latch = { key = fields.lever, open = fields.free, close = 0.01 } },
    numbers = { open_at = fields.open, closed_at = 0.015, pull = fields.open + math.rad(8), pivot = 0.6 },
    shapes = fields.shapes or {},
    grasps = grasps(fields.hanging and { -thick - 0.045, width - 0.040, fields.lever_z - 0.065 }
      or { -thick - 0.045, width - 0.105, fields.lever_z }, fields.hanging),
  }
  table.insert(leaf.shapes, 1, box { thick, width, height, at = { -thick / 2, width / 2, height / 2 } })
  return leaf
end

-- The lever of a leaf: a spindle near its free edge, a bar along -y; it turns down by `most` rad and springs back. Or it hangs, turns
-- up towards -y and stays.
function levers.lever(fields)
  local thick = fields.thick or 0.024
  return {
    type = "lever", parent = fields.leaf, mass = 0.15, colour = brass, friction = 0.8,
    hinge = { axis = { fields.hanging and -1 or 1, 0, 0 }, at = { -thick, fields.width - 0.040, fields.z }, range = { 0, fields.most }, friction = fields.hanging and 0.15 or 0.03,
      stiffness = not fields.hanging and 0.6 or nil, damping = 0.02 },
    numbers = { turn_to = fields.turn },
    shapes = {
      cylinder { 0.009, 0.045, at = { -0.0225, 0, 0 }, rpy = { 0, math.pi / 2, 0 } },
      fields.hanging and box { 0.016, 0.016, 0.110, at = { -0.045, 0, -0.050 } }
        or cylinder { 0.008, 0.110, at = { -0.045, -0.050, 0 }, rpy = { math.pi / 2, 0, 0 } }, -- round: grips from above hold
    },
  }
end

return levers
