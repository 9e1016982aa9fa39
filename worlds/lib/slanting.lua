-- Grasps by a hand that comes forwards and down at an angle: such a hand reaches into shelves as well as onto a table.
local slanting = {}

-- One grasp from the direction `yaw` about the object's z at the point { x, z } of the plane through its z axis;
-- `side` 1 or -1: which finger is where. `down`: angle below the horizontal.
local function one(yaw, x, z, width, force, side, down)
  local pitch = math.pi / 2 - down
  return {
    at = { x * math.cos(yaw), x * math.sin(yaw), z }, rpy = { math.pi, -side * pitch, side > 0 and yaw or yaw + math.pi },
    width = width, approach = 0.07, force = force,
  }
end

-- Fingers on both sides of a box { length, width, height } whose frame is at its middle: near an upper edge of the two
-- ends, so that the palm, 37 mm behind the tip, stays clear of the box; or at height `z`.
function slanting.box(size, force, z)
  local grasps = {}
  local x = -size[1] / 2 + math.min(0.024, size[1] / 2)
  z = z or size[3] / 2 - math.min(0.018, size[3] * 0.45)
  for _, yaw in ipairs { 0, math.pi } do
    for _, down in ipairs { 30, 38, 46 } do
      for _, side in ipairs { 1, -1 } do grasps[#grasps + 1] = one(yaw, x, z, size[2], force, side, math.rad(down)) end
    end
  end
  return grasps
end

-- The same of what lies flat, the fingers just clear of what it lies on; and first from straight above, across its middle:
-- into a drawer no slanting hand reaches.
function slanting.flat(size, force)
  local grasps, clear = {}, 0.0187 -- m
  for _, x in ipairs { 0, -0.02, 0.02 } do
    for _, yaw in ipairs { 0, math.pi } do
      grasps[#grasps + 1] = { at = { x, 0, 0 }, rpy = { math.pi, 0, yaw }, width = size[2], force = force }
    end
  end
  for _, one_of_them in ipairs(slanting.box(size, force, clear - size[3] / 2)) do grasps[#grasps + 1] = one_of_them end
  return grasps
end

-- From any side, of `around` sides (default 12), below the upper rim of a can or jar whose frame is at its middle.
function slanting.round(radius, height, force, around)
  local grasps = {}
  local z = height / 2 - math.min(math.max(0.046 - radius, 0.010), height * 0.4)
  around = around or 12
  for k = 0, around - 1 do
    for _, down in ipairs { 30, 38, 46 } do
      for _, side in ipairs { 1, -1 } do
        grasps[#grasps + 1] = one(k * 2 * math.pi / around, 0, z, 2 * radius, force, side, math.rad(down))
      end
    end
  end
  return grasps
end

return slanting
