-- A desk clock that leans back; a knob in the middle of its face carries the minute hand. Its face looks along -x and up.
local lean = deg(55) -- of the face, from upright
local wood, ivory, black = { 0.42, 0.26, 0.14 }, { 0.96, 0.94, 0.86 }, { 0.10, 0.10, 0.10 }
local radius, middle = 0.075, { -0.010, 0, 0.072 } -- m: of the face; where its middle is

-- A place on the face: up it, across it, out of it.
local function on_face(up, across, out)
  return { middle[1] + up * math.sin(lean) - out * math.cos(lean), across, middle[3] + up * math.cos(lean) + out * math.sin(lean) }
end
local turn = { 0, lean - math.pi / 2, 0 } -- z out of the face

local shapes = {
  box { 0.14, 0.17, 0.012, at = { 0, 0, 0.006 }, colour = wood },
  cylinder { radius + 0.008, 0.024, at = on_face(0, 0, -0.013), rpy = turn, colour = wood },
  cylinder { radius, 0.002, at = on_face(0, 0, 0), rpy = turn, colour = ivory, collides = false },
}
for hour = 1, 12 do
  local angle, thick = hour * math.pi / 6, hour % 3 == 0 and 0.005 or 0.0025
  local at = on_face(0.066 * math.cos(angle), -0.066 * math.sin(angle), 0.0012)
  shapes[#shapes + 1] = box { thick, 0.010, 0.001, at = at, rpy = turn, collides = false,
    colour = hour == 3 and { 0.85, 0.10, 0.10 } or black }
end

return object {
  type = "clock", traits = {}, fixed = true, colour = wood, shapes = shapes,
  parts = {
    minute_hand = {
      type = "clock_hand", traits = { "turnable" }, mass = 0.05, colour = black, friction = 0.7,
      hinge = { axis = { 0, 0, -1 }, at = on_face(0, 0, 0.002), rpy = turn, range = { 0, math.pi }, friction = 0.05, damping = 0.01 },
      shapes = {
        box { 0.058, 0.006, 0.002, at = { 0.029, 0, 0.002 }, collides = false },
        cylinder { 0.012, 0.012, at = { 0, 0, 0.008 }, colour = { 0.75, 0.62, 0.28 } },
        box { 0.044, 0.014, 0.022, at = { 0, 0, 0.024 }, colour = { 0.75, 0.62, 0.28 } }, -- to turn it by
      },
      grasps = each(range(0, 1), function(k)
        return { at = { 0, 0, 0.025 }, rpy = { math.pi, 0, k * math.pi }, width = 0.014, approach = 0.07, force = 25 }
      end),
      numbers = { turn_to = math.rad(91), turned_at = math.rad(86) },
    },
  },
}
