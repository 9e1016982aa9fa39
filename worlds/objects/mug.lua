-- A coffee mug with straight walls and a round handle, by which it hangs: 8 cm across, 9 cm high; its frame is in the
-- middle of its foot.
local height, radius, wall = 0.090, 0.040, 0.004 -- m
local tube, from, up = 0.0045, -0.036, 0.054     -- m: of the handle: its radius, the middle of its arc (y, z)
local out, half = 0.034, 0.026                   -- m: how far the arc reaches out from there, and up and down
local rest = math.rad(24)                        -- from the level up to its axis, when it hangs by the handle

local shapes = {
  lathe { { radius, 0.004 }, { radius, height }, wall = wall },
  cylinder { radius, 0.010, at = { 0, 0, 0.005 } }, -- heavy: it hangs with its mouth up
}
for i = 1, 6 do -- the arc: a hole of 25 x 43 mm between it and the wall
  local a, b = math.pi * (i - 1) / 6, math.pi * i / 6
  local ay, az = from - out * math.sin(a), up + half * math.cos(a)
  local by, bz = from - out * math.sin(b), up + half * math.cos(b)
  shapes[#shapes + 1] = capsule { tube, math.sqrt((by - ay) ^ 2 + (bz - az) ^ 2),
    at = { 0, (ay + by) / 2, (az + bz) / 2 }, rpy = { math.atan(ay - by, bz - az), 0, 0 } }
end

local grasps = {} -- the rim between the fingers, one of them inside; not where the handle is (-y)
local middle = radius - wall / 2 - 0.0012 -- m: the outer finger comes first, so that a mug that hangs is not pulled at
local function take(angle, lean) -- `lean`: of the hand along the wall
  for _, side in ipairs { -1, 1 } do
    grasps[#grasps + 1] = {
      at = { middle * math.cos(angle), middle * math.sin(angle), height - 0.013 },
      rpy = { math.pi, side * lean, angle + side * math.pi / 2 }, width = wall + 0.001, approach = 0.09, force = 20,
    }
  end
end
for _, angle in ipairs { -150, -30, 30, 60, 90, 120, 150 } do take(math.rad(angle), 0) end
for _, lean in ipairs { 25, 45 } do -- over the handle: from above, when it hangs
  for _, angle in ipairs { 0, 30 } do
    take(math.rad(angle), math.rad(lean))
    take(math.rad(180 - angle), -math.rad(lean))
  end
end

return object {
  type = "cup", traits = { "movable", "graspable" }, colour = { 0.18, 0.36, 0.52 },
  mass = 0.25, friction = 0.6, rolling = 0.006, -- it soon stops to swing
  shapes = shapes,
  regions = { -- its -x is up when it hangs
    loop = { at = { 0, -0.0525, up }, rpy = { math.pi / 2, rest, math.pi / 2 }, size = { 0.020, 0.008, 0.020 } },
  },
  numbers = { stands = 1, room = 0.13, swing = math.rad(45) },
  grasps = grasps,
}
