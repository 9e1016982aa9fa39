-- Doors on upright hinges, with a bar to pull them by: what a microwave, a fridge and a washing machine have in common.
local doors = {}

-- Grasps of the upright bar at { x, y, z } of the door's frame, one finger on either side of it, by a hand that comes down
-- at some degrees to the level and from some degrees beside the way straight towards the door.
function doors.grasps(x, y, z, width)
  local list = {}
  for _, down in ipairs { 45, 60, 30 } do
    for _, beside in ipairs { 0, 25, -25, 50, -50 } do
      for _, side in ipairs { 1, -1 } do
        list[#list + 1] = { at = { x, y, z }, width = width, approach = 0.07, force = 40,
          rpy = { math.pi, side * math.rad(90 - down), math.rad(beside) + (side > 0 and math.pi or 0) } }
      end
    end
  end
  return list
end

-- A door in the plane x = 0 of its frame, which is at the foot of the hinge; it closes an opening that looks along -x and
-- reaches from y = 0 to y = `width`. `handle`: where the bar is, up the door, and how long; `round`: the door is a disc.
function doors.door(fields)
  local width, height, thick = fields.width, fields.height, fields.thick or 0.02
  local bar_y, bar_x = width - 0.025, -thick - 0.045
  local door = {
    type = "door", traits = { "openable" }, mass = fields.mass or 1.0, colour = fields.colour,
    hinge = { axis = { 0, 0, 1 }, at = fields.at, range = { 0, math.rad(fields.most or 110) }, friction = 0.25, damping = 0.15 },
    numbers = { pivot = 1, open_at = math.rad(fields.open or 80), closed_at = 0.02, pull = math.rad(fields.pull or (fields.open or 80) + 6) },
    shapes = {
      fields.round and cylinder { width / 2, thick, at = { -thick / 2, width / 2, height / 2 }, rpy = { 0, math.pi / 2, 0 } }
        or box { thick, width, height, at = { -thick / 2, width / 2, height / 2 } },
      cylinder { 0.006, fields.handle.length, at = { bar_x, bar_y, fields.handle.z }, colour = { 0.25, 0.25, 0.27 } },
    },
    grasps = doors.grasps(bar_x, bar_y, fields.handle.z, 0.012),
  }
  for _, end_of in ipairs { 1, -1 } do
    door.shapes[#door.shapes + 1] = box { -bar_x - thick, 0.008, 0.008, colour = { 0.25, 0.25, 0.27 },
      at = { (bar_x - thick) / 2, bar_y, fields.handle.z + end_of * (fields.handle.length / 2 - 0.006) } }
  end
  for _, shape in ipairs(fields.shapes or {}) do door.shapes[#door.shapes + 1] = shape end
  return door
end

return doors
