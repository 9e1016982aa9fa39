-- A laptop; its screen stands up behind the keyboard, which is at -x. Fixed: it is heavy and on rubber feet.
local silver, black = { 0.72, 0.73, 0.75 }, { 0.08, 0.08, 0.09 }
local length, width, base, thick = 0.20, 0.29, 0.014, 0.006 -- m

-- Where closed fingers touch the back of the screen near its far edge: a centimetre off it, at some degrees to straight
-- down on the shut lid, in four turns of the hand about its own axis.
local touches = {}
for _, y in ipairs { 0, 0.09, -0.09 } do
  for _, degrees in ipairs { -90, -75, -60, -45 } do
    local d = math.rad(degrees)
    for _, rpy in ipairs { { math.pi, d, 0 }, { 0, d + math.pi, 0 }, { math.pi - d, 0, -math.pi / 2 }, { math.pi + d, 0, math.pi / 2 } } do
      touches[#touches + 1] = { at = { 0.022 - length, y, thick + 0.021 }, rpy = rpy, width = 0, approach = 0.05, force = 20 }
    end
  end
end

local shapes = {
  box { length + 0.012, width, base, at = { 0, 0, base / 2 } },
  box { 0.07, 0.10, 0.0005, at = { -0.055, 0, base }, colour = { 0.64, 0.65, 0.67 }, collides = false }, -- touch pad
}
for row = 0, 4 do
  shapes[#shapes + 1] = box { 0.016, width - 0.04, 0.001, at = { 0.075 - row * 0.019, 0, base }, colour = black, collides = false }
end

return object {
  type = "laptop", traits = {}, fixed = true, colour = silver, friction = 0.5, shapes = shapes,
  parts = {
    lid = {
      type = "lid", traits = { "openable" }, mass = 0.35, colour = silver, friction = 0.5,
      hinge = { axis = { 0, 1, 0 }, at = { length / 2, 0, base + 0.001 }, range = { 0, math.rad(135) }, friction = 0.45, damping = 0.1 },
      shapes = {
        box { length, width, thick, at = { -length / 2, 0, thick / 2 } },
        box { length - 0.014, width - 0.014, 0.0006, at = { -length / 2 - 0.002, 0, 0 }, colour = { 0.13, 0.20, 0.32 }, collides = false },
        cylinder { 0.012, 0.0006, at = { -length / 2, 0, thick }, colour = { 0.9, 0.9, 0.92 }, collides = false },
      },
      numbers = { open_at = math.rad(85), closed_at = math.rad(2.4), pull = math.rad(100), pivot = 1.2 },
      grasps = touches,
    },
  },
}
