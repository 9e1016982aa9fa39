-- A wooden clothes hanger for a child, 20 cm wide, in the plane x = 0; its frame is in the bend of its hook, where a rod lies.
local wood, wire = { 0.72, 0.52, 0.32 }, { 0.70, 0.72, 0.75 }
local thick, bar = 0.016, 0.014 -- m
local neck, drop, half = -0.055, 0.045, 0.10 -- m: z of the shoulders' middle; how far they fall; to either side

local slope = math.atan(drop, half)
local long = math.sqrt(drop ^ 2 + half ^ 2)
local shapes = {
  box { 0.005, 0.0225, 0.005, at = { 0, 0.0069, 0.0074 }, rpy = { -deg(50), 0, 0 }, colour = wire }, -- the bend: a steep roof over the rod
  box { 0.005, 0.0225, 0.005, at = { 0, -0.0069, 0.0074 }, rpy = { deg(50), 0, 0 }, colour = wire },
  box { 0.005, 0.005, 0.048, at = { 0, 0.007, -0.024 }, rpy = { -0.326, 0, 0 }, colour = wire }, -- back to the neck
  box { thick, 2 * half, bar, at = { 0, 0, neck - drop }, colour = wood },
}
local grasps = {}
for _, side in ipairs { 1, -1 } do
  shapes[#shapes + 1] = box { thick, long, bar, at = { 0, side * half / 2, neck - drop / 2 }, rpy = { -side * slope, 0, 0 }, colour = wood }
  for _, y in ipairs { 0.050, 0.062, 0.074 } do -- a shoulder between the fingers, from above beside the rod
    for _, yaw in ipairs { math.pi / 2, -math.pi / 2 } do
      grasps[#grasps + 1] = { at = { 0, side * y, neck - drop * y / half }, rpy = { math.pi, 0, yaw }, width = thick, approach = 0.07, force = 32 }
    end
  end
end

return object {
  type = "hanger", traits = { "movable", "graspable" }, mass = 0.09, friction = 0.5, colour = wood, shapes = shapes, grasps = grasps,
  numbers = { turns = 2 },
  regions = { loop = { at = { 0, 0, 0 }, rpy = { 0, math.pi / 2, 0 }, size = { 0.004, 0.004, 0.004 } } },
}
